// Inverse dynamics, and whole estimations.
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "benchmarks.h"
#include "cases.h"
#include "dpe/engine/simulator.h"
#include "dpe/estimation/estimator.h"
#include "dpe/estimation/inverse_dynamics.h"
#include "dpe/estimation/observations.h"
#include "resource_usage.h"

namespace dpe::bench {
namespace {

constexpr GridPlan kInverseDynamicsGrids[] = {
    {12, 100, 1}, {24, 50, 1}, {48, 13, 1}, {96, 4, 1}, {192, 3, 1}};

struct EstimationPlan {
  const char* name;
  const char* settings;
  int grid;
  int num_frames;
  InitMethod init;
  double init_perturbation;
  int max_iterations;  // negative: until it converges
};

// Fewer frames of larger cloths, as in cases.h: three iterations of nG are the same
// work per frame on every grid, while nL ends where a few frames no longer determine
// it. nL_auto starts from inverse dynamics, which leaves nothing to do on exact data of
// methods 2 and 3 (method 4's start is approximate: hence the limit); the perturbed
// starts make Levenberg-Marquardt work.
constexpr EstimationPlan kEstimations[] = {
    {"nG_perturbed", "nG", 12, 100, InitMethod::kScene, 0.5, -1},
    {"nL_auto", "nL", 12, 100, InitMethod::kAuto, 0.0, 3},
    {"nL_auto", "nL", 24, 30, InitMethod::kAuto, 0.0, 3},
    {"nL_auto", "nL", 48, 13, InitMethod::kAuto, 0.0, 3},
    {"nG_three_iterations", "nG", 12, 100, InitMethod::kScene, 0.1, 3},
    {"nG_three_iterations", "nG", 24, 51, InitMethod::kScene, 0.1, 3},
    {"nG_three_iterations", "nG", 48, 16, InitMethod::kScene, 0.1, 3},
    {"nG_three_iterations", "nG", 96, 6, InitMethod::kScene, 0.1, 3},
    {"nG_three_iterations", "nG", 192, 3, InitMethod::kScene, 0.1, 3},
    {"nL_ten_iterations", "nL", 12, 20, InitMethod::kScene, 0.1, 10},
    {"nL_two_iterations", "nL", 12, 100, InitMethod::kScene, 0.01, 2},
};

// The scene's own motion, by the simulator that the estimation uses too: data of
// another Newton tolerance would not be exact for it. Nothing, and an error, if that
// fails.
Observations MotionOf(const Scene& scene, int num_frames, benchmark::State* state) {
  Simulator simulator(scene);
  const Trajectory trajectory = simulator.Simulate(num_frames);
  if (!trajectory.status.ok()) {
    state->SkipWithError(trajectory.status.Message().c_str());
    return {};
  }
  return ObserveAll(trajectory);
}

void InverseDynamics(benchmark::State& state, const Case& c) {
  const MemoryPeak memory;
  const Scene scene = MakeScene(c);
  const Observations observations = MotionOf(scene, c.plan.num_frames, &state);
  if (observations.positions.empty()) return;
  Simulator simulator(scene);
  const std::vector<double> total_mass = {scene.objects[0].mass.sum()};
  InverseDynamicsResult result;
  const double start = CpuSeconds();
  for (auto _ : state) {
    result =
        SolveInverseDynamics(&simulator, observations, c.plan.num_frames, total_mass);
  }
  if (!result.ok) {
    state.SkipWithError(result.message.c_str());
    return;
  }
  const Eigen::VectorXd truth = simulator.layout().Extract(scene);
  state.counters["ms"] =
      1e3 * (CpuSeconds() - start) / static_cast<double>(state.iterations());
  state.counters["vertices"] = c.plan.size * c.plan.size;
  state.counters["parameters"] = static_cast<double>(truth.size());
  state.counters["frames"] = c.plan.num_frames;
  state.counters["deviation_percent"] =
      100.0 * ((result.parameters - truth).array() / truth.array()).abs().mean();
  state.counters["peak_mib"] = memory.Mebibytes();
}

void Estimation(benchmark::State& state, const Case& c, const EstimationPlan& plan) {
  const MemoryPeak memory;
  Scene scene = MakeScene(c);
  ApplySettings(plan.settings, &scene);
  const Observations observations = MotionOf(scene, plan.num_frames, &state);
  if (observations.positions.empty()) return;
  EstimatorOptions options;
  options.init = plan.init;
  options.init_perturbation = plan.init_perturbation;
  options.max_iterations = plan.max_iterations;
  EstimatorSummary summary;
  const double start = CpuSeconds();
  for (auto _ : state) summary = Estimate(scene, observations, options);
  state.counters["ms"] =
      1e3 * (CpuSeconds() - start) / static_cast<double>(state.iterations());
  state.counters["vertices"] = plan.grid * plan.grid;
  state.counters["parameters"] = static_cast<double>(summary.parameters.size());
  state.counters["frames"] = plan.num_frames;
  state.counters["iterations"] = summary.iterations;
  state.counters["rollouts"] = summary.evaluations;
  state.counters["jacobians"] = summary.jacobian_evaluations;
  state.counters["final_rms"] = summary.final_rms;
  state.counters["peak_mib"] = memory.Mebibytes();
  state.SetLabel(TerminationName(summary.termination) + ", " + summary.solver);
}

template <class Body>
void RegisterOnce(const std::string& name, Body body) {
  benchmark::RegisterBenchmark(name.c_str(), body)
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime()
      ->Iterations(1);
}

}  // namespace

void RegisterEstimation() {
  for (IntegrationMethod method : kMethods) {
    for (const GridPlan& plan : kInverseDynamicsGrids) {
      const Case c{ScenePreset::kSide, "side", method, plan};
      RegisterOnce(CaseName("inverse_dynamics", c),
                   [c](benchmark::State& state) { InverseDynamics(state, c); });
    }
    for (const EstimationPlan& plan : kEstimations) {
      const Case c{ScenePreset::kSide, "side", method, {plan.grid, plan.num_frames, 1}};
      RegisterOnce(CaseName(std::string("estimation_") + plan.name, c),
                   [c, plan](benchmark::State& state) { Estimation(state, c, plan); });
    }
  }
}

}  // namespace dpe::bench
