// The one place that lists every kind of job and every experiment: a line each.
#include "experiments/experiment.h"
#include "experiments/fits/estimate.h"
#include "experiments/fits/experiment1.h"
#include "experiments/fits/experiment2.h"
#include "experiments/fits/floor.h"
#include "experiments/requirements/cost_job.h"
#include "experiments/requirements/features.h"
#include "experiments/selftest.h"
#include "experiments/stability/stability.h"
#include "experiments/tradeoff/tradeoff.h"

namespace dpe::experiments {

const std::vector<JobKind>& JobKinds() {
  static const std::vector<JobKind> kinds = {
      CostJobKind(),     SelfTestKind(),          EstimateKind(),
      FloorKind(),       TradeoffReferenceKind(), TradeoffSimulationKind(),
      TradeoffFitKind(), StabilityJobKind(),      EnergyJobKind(),
  };
  return kinds;
}

const std::vector<Experiment>& Experiments() {
  static const std::vector<Experiment> experiments = {
      Experiment1(),         Experiment2(),        OnlyWhatItRequires(),
      StabilityExperiment(), TradeoffExperiment(),
  };
  return experiments;
}

}  // namespace dpe::experiments
