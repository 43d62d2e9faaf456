// How much memory long and large gradients take.
#include <benchmark/benchmark.h>

#include <cstddef>
#include <string>

#include "benchmarks.h"
#include "cases.h"
#include "dpe/engine/sensitivity.h"
#include "dpe/engine/simulator.h"
#include "resource_usage.h"

namespace dpe::bench {
namespace {

struct MemoryPlan {
  int grid;
  int num_frames;
  int steps_per_frame;
  int limit_mib;  // 0: the default
};

// With fewer steps in a frame energy rises (linearly_implicit_euler.h).
constexpr MemoryPlan kPlans[] = {{192, 100, 16, 0}, {96, 500, 4, 0}, {96, 500, 4, 512}};

void GradientMemory(benchmark::State& state, const Case& c, int steps_per_frame,
                    int limit_mib) {
  SimulatorOptions options;
  if (limit_mib > 0) {
    options.memory_limit_bytes = static_cast<std::size_t>(limit_mib) << 20;
  }
  const MemoryPeak memory;
  Scene scene = MakeScene(c);
  scene.steps_per_frame = steps_per_frame;
  Simulator simulator(scene, options);
  const Eigen::VectorXd parameters = simulator.layout().Extract(scene);
  std::string error;
  double gradient_norm = 0.0;
  const double start = CpuSeconds();
  for (auto _ : state) {
    const Rollout rollout = simulator.Run(parameters, c.plan.num_frames);
    if (!rollout.status().ok()) {
      error = rollout.status().Message();
      break;
    }
    Sensitivity sensitivity(&simulator, &rollout);
    gradient_norm = sensitivity.Gradient(rollout.trajectory().positions).norm();
    if (!sensitivity.ok()) error = "the backward pass failed";
  }
  if (!error.empty()) {
    state.SkipWithError(error.c_str());
    return;
  }
  state.counters["ms"] = 1e3 * (CpuSeconds() - start) / state.iterations();
  state.counters["frames"] = c.plan.num_frames;
  state.counters["limit_mib"] = limit_mib;
  state.counters["peak_mib"] = memory.Mebibytes();
  state.counters["resident_mib"] = memory.ResidentMebibytes();
  state.counters["gradient_norm"] = gradient_norm;
}

}  // namespace

void RegisterMemory() {
  for (const MemoryPlan& plan : kPlans) {
    const Case c{ScenePreset::kSide,
                 "side",
                 IntegrationMethod::kLinearlyImplicitEuler,
                 {plan.grid, plan.num_frames, 1}};
    const std::string name = CaseName("memory", c) +
                             "/frames:" + std::to_string(plan.num_frames) +
                             "/steps:" + std::to_string(plan.steps_per_frame) +
                             "/limit:" + std::to_string(plan.limit_mib) + "/slow:1";
    benchmark::RegisterBenchmark(name.c_str(),
                                 [c, plan](benchmark::State& state) {
                                   GradientMemory(state, c, plan.steps_per_frame,
                                                  plan.limit_mib);
                                 })
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime()
        ->Iterations(1);
  }
}

}  // namespace dpe::bench
