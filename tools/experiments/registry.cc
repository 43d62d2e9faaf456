// The one place that lists every kind of job and every experiment: a line each.
#include "experiments/experiment.h"
#include "experiments/requirements/cost_job.h"
#include "experiments/requirements/features.h"
#include "experiments/selftest.h"

namespace dpe::experiments {

const std::vector<JobKind>& JobKinds() {
  static const std::vector<JobKind> kinds = {
      CostJobKind(),
      SelfTestKind(),
  };
  return kinds;
}

const std::vector<Experiment>& Experiments() {
  static const std::vector<Experiment> experiments = {
      OnlyWhatItRequires(),
  };
  return experiments;
}

}  // namespace dpe::experiments
