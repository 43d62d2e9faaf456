// What the rows of the trade-off experiment say.
#ifndef DPE_TOOLS_EXPERIMENTS_TRADEOFF_RESULTS_H_
#define DPE_TOOLS_EXPERIMENTS_TRADEOFF_RESULTS_H_

#include <vector>

#include "experiments/experiment.h"

namespace dpe::experiments::tradeoff {

Results TradeoffResults(const std::vector<Row>& rows);

}  // namespace dpe::experiments::tradeoff

#endif  // DPE_TOOLS_EXPERIMENTS_TRADEOFF_RESULTS_H_
