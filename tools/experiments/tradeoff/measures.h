// What a candidate costs and how good its derivatives are.
#ifndef DPE_TOOLS_EXPERIMENTS_TRADEOFF_MEASURES_H_
#define DPE_TOOLS_EXPERIMENTS_TRADEOFF_MEASURES_H_

#include <functional>

#include "dpe/engine/timings.h"
#include "dpe/engine/trajectory.h"
#include "experiments/record.h"
#include "experiments/tradeoff/candidate.h"

namespace dpe::experiments::tradeoff {

// Processor time of this process so far, s.
double CpuSeconds();

// The least processor time (s) of several calls: at least `repeats`, and more until
// they have taken kMinMeasuredSeconds together, at most kMaxRepeats. Other programs
// disturb it only upwards.
constexpr double kMinMeasuredSeconds = 0.1;
constexpr int kMaxRepeats = 20;
double LeastCpuSeconds(int repeats, const std::function<void()>& call);

// Calls of what a rollout consists of, per frame: work that is the same on every
// machine. Of the direct solver a factorisation costs the most, of the Krylov solver a
// solve.
void SetWork(const Timings& timings, int frames, Record* row);

// How exact the candidate's derivatives are, for a linear functional L = sum w . x of
// the first kGradientFrames frames with random weights, in all spring stiffnesses.
struct GradientErrors {
  // |g - g*| / |g*|, g being the candidate's gradient by the adjoint and g* that of the
  // same time stepping solved to rounding level: what its tolerances cost.
  double solve = 0.0;
  // | g* . d - difference quotient | / | difference quotient | along a random
  // direction d: that g* is the derivative of the map. NaN unless asked for.
  double difference = 0.0;
  double kept_mib = 0.0;  // what the candidate's rollout keeps for its derivatives
};
constexpr int kGradientFrames = 21;
// NaN where a rollout or a pass fails.
GradientErrors MeasureGradient(const Candidate& candidate, bool with_difference);

}  // namespace dpe::experiments::tradeoff

#endif  // DPE_TOOLS_EXPERIMENTS_TRADEOFF_MEASURES_H_
