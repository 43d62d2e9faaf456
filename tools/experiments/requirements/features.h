// The experiment only_what_it_requires: what each feature costs, when it is there and
// when it is not.
#ifndef DPE_TOOLS_EXPERIMENTS_REQUIREMENTS_FEATURES_H_
#define DPE_TOOLS_EXPERIMENTS_REQUIREMENTS_FEATURES_H_

#include <string>
#include <vector>

#include "experiments/experiment.h"

namespace dpe::experiments {

// Which configurations (ids of CostConfigurations) are compared for a feature.
struct Feature {
  std::string name;
  // In which it cannot be: the scene or the command line says nothing of it. Empty:
  // there is none, every cloth has a mass.
  std::string impossible;
  std::string off;  // mentioned and turned off
  std::string on;
  std::string code;     // name of its FeatureCode; empty: it has none of its own
  std::string without;  // what `on` is compared with; empty: `off`
};

const std::vector<Feature>& ComparedFeatures();

// Every configuration that is counted.
std::vector<Job> CostConfigurations();

Experiment OnlyWhatItRequires();

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_REQUIREMENTS_FEATURES_H_
