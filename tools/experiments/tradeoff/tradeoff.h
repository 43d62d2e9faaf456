// The trade-off experiment: what accuracy costs.
#ifndef DPE_TOOLS_EXPERIMENTS_TRADEOFF_TRADEOFF_H_
#define DPE_TOOLS_EXPERIMENTS_TRADEOFF_TRADEOFF_H_

#include "experiments/experiment.h"

namespace dpe::experiments {

JobKind TradeoffReferenceKind();
JobKind TradeoffSimulationKind();
JobKind TradeoffFitKind();

Experiment TradeoffExperiment();

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_TRADEOFF_TRADEOFF_H_
