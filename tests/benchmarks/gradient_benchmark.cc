// The gradient of a scalar of all frames: rollout and backward pass, timed apart.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>

#include "benchmarks.h"
#include "cases.h"
#include "dpe/engine/sensitivity.h"
#include "dpe/engine/simulator.h"
#include "resource_usage.h"

namespace dpe::bench {
namespace {

// s, of one gradient; of several, the least of each.
struct GradientTimes {
  double alone = 0.0;  // a rollout that records nothing
  double rollout = 0.0;
  double backward = 0.0;
  double both = 0.0;

  void TakeLeast(const GradientTimes& other) {
    alone = std::min(alone, other.alone);
    rollout = std::min(rollout, other.rollout);
    backward = std::min(backward, other.backward);
    both = std::min(both, other.both);
  }
};

// L = 1/2 sum |x|^2 over all frames, so dL/dx = x. @return false if a pass failed
bool TimeGradient(const GridPlan& plan, Simulator* simulator,
                  const Eigen::VectorXd& parameters, GradientTimes* times) {
  double start = CpuSeconds();
  if (!simulator->Simulate(plan.num_frames).status.ok()) return false;
  times->alone = CpuSeconds() - start;
  start = CpuSeconds();
  const Rollout rollout = simulator->Run(parameters, plan.num_frames);
  if (!rollout.status().ok()) return false;
  const double middle = CpuSeconds();
  Sensitivity sensitivity(simulator, &rollout);
  benchmark::DoNotOptimize(sensitivity.Gradient(rollout.trajectory().positions));
  const double end = CpuSeconds();
  times->rollout = middle - start;
  times->backward = end - middle;
  times->both = end - start;
  return sensitivity.ok();
}

void Gradient(benchmark::State& state, const Case& c) {
  const MemoryPeak memory;
  const Scene scene = MakeScene(c);
  Simulator simulator(scene);
  const Eigen::VectorXd parameters = simulator.layout().Extract(scene);
  // The first one meets fresh memory, those of an optimiser's later iterations do not.
  GradientTimes first, least, times;
  bool ok = TimeGradient(c.plan, &simulator, parameters, &first) &&
            TimeGradient(c.plan, &simulator, parameters, &least);
  for (auto _ : state) {
    ok = ok && TimeGradient(c.plan, &simulator, parameters, &times);
    least.TakeLeast(times);
  }
  if (!ok) {
    state.SkipWithError("the rollout or its backward pass failed");
    return;
  }
  const double scale = 1e3 / (c.plan.num_frames - 1);
  state.counters["first_ms"] = scale * first.both;
  state.counters["ms_per_frame"] = scale * least.both;
  state.counters["alone_ms"] = scale * least.alone;
  state.counters["rollout_ms"] = scale * least.rollout;
  state.counters["backward_ms"] = scale * least.backward;
  state.counters["vertices"] = c.plan.size * c.plan.size;
  state.counters["parameters"] = simulator.layout().size();
  state.counters["frames"] = c.plan.num_frames;
  state.counters["peak_mib"] = memory.Mebibytes();
}

// Small cloths are measured often: a ratio of short times is easily disturbed.
int NumGradients(const GridPlan& plan) {
  return plan.size <= 24 ? 10 : plan.size <= 48 ? 3 : 1;
}

void Register(const std::string& what, const Case& c) {
  benchmark::RegisterBenchmark(CaseName(what, c).c_str(),
                               [c](benchmark::State& state) { Gradient(state, c); })
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime()
      ->Iterations(NumGradients(c.plan));
}

// A hundred frames of every grid, with the solver that it is for: over a few frames
// from rest the backward pass has no solution to start its iterations from yet.
void RegisterHundredFrames(GridPlan plan) {
  constexpr int kLargestDirect = 48;
  plan.num_frames = 100;
  for (const char* solver : {"cholesky", "cg"}) {
    const bool is_direct = std::string(solver) == "cholesky";
    if (plan.size > (is_direct ? kLargestDirect : 96)) continue;
    Register("gradient_of_100_frames",
             {ScenePreset::kSide, "side", kMethods[0], plan, solver});
  }
}

}  // namespace

void RegisterGradient() {
  for (const GridPlan& plan : kGrids) {
    for (const char* solver : kSolvers) {
      for (IntegrationMethod method : kMethods) {
        Register("gradient", {ScenePreset::kSide, "side", method, plan, solver});
      }
    }
    RegisterHundredFrames(plan);
  }
}

}  // namespace dpe::bench
