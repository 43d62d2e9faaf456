// Jacobians of all positions with respect to the stiffnesses, by the tangent pass.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>
#include <vector>

#include "benchmarks.h"
#include "cases.h"
#include "dpe/engine/sensitivity.h"
#include "dpe/engine/simulator.h"
#include "resource_usage.h"

namespace dpe::bench {
namespace {

struct JacobianPlan {
  int grid;
  int num_frames;
  int num_columns;  // parameters; 0: one per spring (nL)
  int num_threads;
};

// A column per spring is what nL asks for, but beyond 12 x 12 vertices that takes too
// long for a benchmark: there the springs are put into a few groups, and the figure to
// compare is the time per frame and column.
constexpr JacobianPlan kPlans[] = {
    {12, 100, 0, 1}, {12, 100, 0, 2}, {24, 3, 0, 1},
    {24, 11, 32, 1}, {48, 6, 32, 1},  {96, 3, 32, 1},
};

Scene MakeJacobianScene(const Case& c, const JacobianPlan& plan) {
  Scene scene = MakeScene(c);
  if (plan.num_columns == 0) return scene;
  ClothObject& cloth = scene.objects[0];
  cloth.stiffness_mode = ParameterMode::kGroup;
  cloth.spring_group.resize(cloth.num_springs());
  for (int s = 0; s < cloth.num_springs(); ++s) {
    cloth.spring_group[s] = s % plan.num_columns;
  }
  return scene;
}

// Residual rows: every coordinate of every vertex at every frame but the first.
std::vector<StateDerivative> ObserveAllPositions(int num_coordinates, int num_frames) {
  std::vector<StateDerivative> derivatives(num_frames - 1);
  for (int frame = 1; frame < num_frames; ++frame) {
    StateDerivative& derivative = derivatives[frame - 1];
    derivative.frame = frame;
    derivative.first_row = (frame - 1) * num_coordinates;
    derivative.d_position.resize(num_coordinates, num_coordinates);
    derivative.d_position.setIdentity();
  }
  return derivatives;
}

void Jacobian(benchmark::State& state, const Case& c, const JacobianPlan& plan) {
  const MemoryPeak memory;
  const Scene scene = MakeJacobianScene(c, plan);
  SimulatorOptions options;
  options.num_threads = plan.num_threads;
  Simulator simulator(scene, options);
  const Eigen::VectorXd parameters = simulator.layout().Extract(scene);
  const Rollout rollout = simulator.Run(parameters, plan.num_frames);
  const int num_coordinates = 3 * scene.objects[0].num_vertices();
  const auto derivatives = ObserveAllPositions(num_coordinates, plan.num_frames);
  Sensitivity sensitivity(&simulator, &rollout);
  const double start = CpuSeconds();
  for (auto _ : state) {
    const RowMajorMatrix jacobian = sensitivity.Jacobian(
        derivatives, num_coordinates * (plan.num_frames - 1), JacobianMethod::kTangent);
    benchmark::DoNotOptimize(jacobian.data());
  }
  if (!rollout.status().ok() || !sensitivity.ok()) {
    state.SkipWithError("the rollout or its tangent pass failed");
    return;
  }
  const double milliseconds =
      1e3 * (CpuSeconds() - start) / static_cast<double>(state.iterations());
  const int num_columns = simulator.layout().size();
  state.counters["ms"] = milliseconds;
  state.counters["us_per_frame_and_column"] =
      1e3 * milliseconds / (plan.num_frames - 1) / num_columns;
  state.counters["vertices"] = plan.grid * plan.grid;
  state.counters["columns"] = num_columns;
  state.counters["frames"] = plan.num_frames;
  state.counters["threads"] = plan.num_threads;
  state.counters["peak_mib"] = memory.Mebibytes();
}

}  // namespace

void RegisterJacobian() {
  for (IntegrationMethod method : kMethods) {
    for (const JacobianPlan& plan : kPlans) {
      const Case c{ScenePreset::kSide, "side", method, {plan.grid, plan.num_frames, 1}};
      const std::string name = CaseName("jacobian", c) +
                               "/columns:" + std::to_string(plan.num_columns) +
                               "/threads:" + std::to_string(plan.num_threads);
      benchmark::RegisterBenchmark(
          name.c_str(),
          [c, plan](benchmark::State& state) { Jacobian(state, c, plan); })
          ->Unit(benchmark::kMillisecond)
          ->MeasureProcessCPUTime()
          ->Iterations(1);
    }
  }
}

}  // namespace dpe::bench
