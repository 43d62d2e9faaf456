// What is to be said of an analysis, in sentences.
#ifndef DPE_ESTIMATION_UNCERTAINTY_TEXT_H_
#define DPE_ESTIMATION_UNCERTAINTY_TEXT_H_

#include <string>
#include <vector>

#include "dpe/estimation/uncertainty.h"

namespace dpe {

// Of noise, directions and parameters. Several parameters of one block of which the
// same holds share a sentence.
std::vector<std::string> MakeStatements(const Uncertainty& uncertainty,
                                        const UncertaintyOptions& options);

}  // namespace dpe

#endif  // DPE_ESTIMATION_UNCERTAINTY_TEXT_H_
