// Tables and plots of the simulations.
#ifndef DPE_TOOLS_EXPERIMENTS_TRADEOFF_SIMULATION_RESULTS_H_
#define DPE_TOOLS_EXPERIMENTS_TRADEOFF_SIMULATION_RESULTS_H_

#include <vector>

#include "experiments/experiment.h"

namespace dpe::experiments::tradeoff {

void AddSimulationResults(const std::vector<Row>& rows, Results* results);

}  // namespace dpe::experiments::tradeoff

#endif  // DPE_TOOLS_EXPERIMENTS_TRADEOFF_SIMULATION_RESULTS_H_
