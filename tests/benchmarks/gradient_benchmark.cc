// The gradient of a scalar of all frames: rollout and backward pass, timed apart.
#include <benchmark/benchmark.h>

#include "benchmarks.h"
#include "cases.h"
#include "dpe/engine/sensitivity.h"
#include "dpe/engine/simulator.h"
#include "resource_usage.h"

namespace dpe::bench {
namespace {

struct GradientTimes {
  double rollout = 0.0;   // s
  double backward = 0.0;  // s
};

// L = 1/2 sum |x|^2 over all frames, so dL/dx = x. @return false if a pass failed
bool AddGradientTimes(const GridPlan& plan, Simulator* simulator,
                      const Eigen::VectorXd& parameters, GradientTimes* times) {
  const double start = CpuSeconds();
  const Rollout rollout = simulator->Run(parameters, plan.num_frames);
  if (!rollout.status().ok()) return false;
  const double middle = CpuSeconds();
  Sensitivity sensitivity(simulator, &rollout);
  benchmark::DoNotOptimize(sensitivity.Gradient(rollout.trajectory().positions));
  times->rollout += middle - start;
  times->backward += CpuSeconds() - middle;
  return sensitivity.ok();
}

void Gradient(benchmark::State& state, const Case& c) {
  const MemoryPeak memory;
  const Scene scene = MakeScene(c);
  Simulator simulator(scene);
  const Eigen::VectorXd parameters = simulator.layout().Extract(scene);
  // The first one meets fresh memory, those of an optimiser's later iterations do not.
  GradientTimes first, times;
  if (!AddGradientTimes(c.plan, &simulator, parameters, &first)) {
    state.SkipWithError("the rollout or its backward pass failed");
    return;
  }
  for (auto _ : state) {
    if (!AddGradientTimes(c.plan, &simulator, parameters, &times)) {
      state.SkipWithError("the rollout or its backward pass failed");
      return;
    }
  }
  const double scale_of_one = 1e3 / (c.plan.num_frames - 1);
  const double scale = scale_of_one / static_cast<double>(state.iterations());
  state.counters["first_ms"] = scale_of_one * (first.rollout + first.backward);
  state.counters["ms_per_frame"] = scale * (times.rollout + times.backward);
  state.counters["rollout_ms"] = scale * times.rollout;
  state.counters["backward_ms"] = scale * times.backward;
  state.counters["vertices"] = c.plan.size * c.plan.size;
  state.counters["parameters"] = simulator.layout().size();
  state.counters["frames"] = c.plan.num_frames;
  state.counters["peak_mib"] = memory.Mebibytes();
}

}  // namespace

void RegisterGradient() {
  for (const GridPlan& plan : kGrids) {
    for (const char* solver : kSolvers) {
      for (IntegrationMethod method : kMethods) {
        const Case c{ScenePreset::kSide, "side", method, plan, solver};
        benchmark::RegisterBenchmark(
            CaseName("gradient", c).c_str(),
            [c](benchmark::State& state) { Gradient(state, c); })
            ->Unit(benchmark::kMillisecond)
            ->MeasureProcessCPUTime()
            ->Iterations(plan.num_rollouts);
      }
    }
  }
}

}  // namespace dpe::bench
