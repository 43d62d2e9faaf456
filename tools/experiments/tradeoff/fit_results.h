// Tables and plots of the fits.
#ifndef DPE_TOOLS_EXPERIMENTS_TRADEOFF_FIT_RESULTS_H_
#define DPE_TOOLS_EXPERIMENTS_TRADEOFF_FIT_RESULTS_H_

#include <vector>

#include "experiments/experiment.h"

namespace dpe::experiments::tradeoff {

void AddFitResults(const std::vector<Row>& rows, Results* results);

}  // namespace dpe::experiments::tradeoff

#endif  // DPE_TOOLS_EXPERIMENTS_TRADEOFF_FIT_RESULTS_H_
