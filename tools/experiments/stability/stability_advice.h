// Which integrator to trust where, what fails there and by what name: the tables of the
// stability experiment that a user reads first.
#ifndef DPE_TOOLS_EXPERIMENTS_STABILITY_STABILITY_ADVICE_H_
#define DPE_TOOLS_EXPERIMENTS_STABILITY_STABILITY_ADVICE_H_

#include <string>
#include <vector>

#include "experiments/experiment.h"

namespace dpe::experiments {

// The reason of a failed cell in a few words, the same ones for the same reason.
std::string FailureName(const Row& row);

// How many of the tested values each method came through.
Table MethodTable(const std::vector<Row>& rows);

// A line per axis: what to use from which value to which, and what fails at which.
// Nothing is said of values between two tested ones that come to different advice.
Table AdviceTable(const std::vector<Row>& rows);

// A line per value.
Table TrustTable(const std::vector<Row>& rows);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_STABILITY_STABILITY_ADVICE_H_
