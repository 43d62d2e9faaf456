// Plots of the stability experiment: for each axis what came of which method at which
// value, and the histories of the undamped free cloth.
#ifndef DPE_TOOLS_EXPERIMENTS_STABILITY_STABILITY_PLOTS_H_
#define DPE_TOOLS_EXPERIMENTS_STABILITY_STABILITY_PLOTS_H_

#include <vector>

#include "experiments/experiment.h"

namespace dpe::experiments {

std::vector<Plot> StabilityPlots(const std::vector<Row>& rows);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_STABILITY_STABILITY_PLOTS_H_
