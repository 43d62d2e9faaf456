#include "experiments/tradeoff/tradeoff.h"

#include "experiments/tradeoff/grid.h"
#include "experiments/tradeoff/jobs.h"
#include "experiments/tradeoff/reference.h"
#include "experiments/tradeoff/results.h"

namespace dpe::experiments {

JobKind TradeoffReferenceKind() {
  return {"tradeoff_reference",
          "how far the reference motion of a scene may be trusted",
          tradeoff::RunReferenceJob};
}

JobKind TradeoffSimulationKind() {
  return {"tradeoff_simulation",
          "error, gradient error and cost of a scene's simulation with given settings",
          tradeoff::RunSimulationJob};
}

JobKind TradeoffFitKind() {
  return {"tradeoff_fit",
          "bias and cost of a fit to the reference motion with given settings",
          tradeoff::RunFitJob};
}

Experiment TradeoffExperiment() {
  return {"tradeoff",
          "what accuracy costs: error against time of every way to simulate and fit",
          "What accuracy costs", tradeoff::TradeoffJobs, tradeoff::TradeoffResults};
}

}  // namespace dpe::experiments
