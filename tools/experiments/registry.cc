// The one place that lists every kind of job and every experiment: a line each.
#include "experiments/experiment.h"
#include "experiments/selftest.h"
#include "experiments/tradeoff/tradeoff.h"

namespace dpe::experiments {

const std::vector<JobKind>& JobKinds() {
  static const std::vector<JobKind> kinds = {
      SelfTestKind(),
      TradeoffReferenceKind(),
      TradeoffSimulationKind(),
      TradeoffFitKind(),
  };
  return kinds;
}

const std::vector<Experiment>& Experiments() {
  static const std::vector<Experiment> experiments = {
      TradeoffExperiment(),
  };
  return experiments;
}

}  // namespace dpe::experiments
