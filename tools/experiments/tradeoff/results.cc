#include "experiments/tradeoff/results.h"

#include "experiments/tradeoff/fit_results.h"
#include "experiments/tradeoff/simulation_results.h"

namespace dpe::experiments::tradeoff {

Results TradeoffResults(const std::vector<Row>& rows) {
  Results results;
  AddSimulationResults(rows, &results);
  AddFitResults(rows, &results);
  return results;
}

}  // namespace dpe::experiments::tradeoff
