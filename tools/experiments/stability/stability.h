// The stability experiment: its kinds of job, and the campaign.
#ifndef DPE_TOOLS_EXPERIMENTS_STABILITY_STABILITY_H_
#define DPE_TOOLS_EXPERIMENTS_STABILITY_STABILITY_H_

#include <vector>

#include "experiments/experiment.h"

namespace dpe::experiments {

// Arguments: axis, value, integrator (0 to 4), solver.
JobKind StabilityJobKind();
// Arguments: integrator (0 to 4). See energy_history.h.
JobKind EnergyJobKind();

Experiment StabilityExperiment();

// Every cell as a job, those of `axis` only if it is not empty.
std::vector<Job> StabilityJobs(const std::string& axis = {});

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_STABILITY_STABILITY_H_
