// The kind of job "cost": what one configuration costs.
#ifndef DPE_TOOLS_EXPERIMENTS_REQUIREMENTS_COST_JOB_H_
#define DPE_TOOLS_EXPERIMENTS_REQUIREMENTS_COST_JOB_H_

#include <string>
#include <vector>

#include "experiments/experiment.h"

namespace dpe::experiments {

// Arguments are those of cost_configuration.h, and
//   frames        simulated or fitted while instructions are counted (20)
//   time_frames   and while time is measured (500)
//   repetitions   of the measurement of time, of which the least counts (7)
// The row holds
//   instructions      outside of the C library
//   code_NAME         those of them in the code of a feature (CodeOfFeatures)
//   rollouts          of an estimation
//   program_cpu_s     processor time of the whole program with time_frames
constexpr int kTimeFrames = 500;
JobKind CostJobKind();

// The code that belongs to one feature alone: parts of names of functions. What the
// compiler inlines elsewhere is not seen.
struct FeatureCode {
  std::string name;
  std::vector<std::string> functions;
};
const std::vector<FeatureCode>& CodeOfFeatures();

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_REQUIREMENTS_COST_JOB_H_
