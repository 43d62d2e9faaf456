// A forward frame, and beside it the floor.
#include <benchmark/benchmark.h>

#include <memory>
#include <string>

#include "benchmarks.h"
#include "cases.h"
#include "cholesky_floor.h"
#include "dpe/engine/simulator.h"
#include "dpe/engine/timings.h"
#include "resource_usage.h"

namespace dpe::bench {
namespace {

// The floor of a case's grid and preset. The last one is kept: methods and repetitions
// that follow each other share its analysis, while each measures anew. Null if there is
// no matrix to measure.
CholeskyFloor* FloorOf(const Case& c) {
  static std::string last_key;
  static std::unique_ptr<CholeskyFloor> last;
  const std::string key = c.preset_name + std::to_string(c.plan.size);
  if (key == last_key) return last.get();
  last_key = key;
  last.reset();
  const SymmetricMatrix matrix = StepMatrix(c);
  if (matrix.num_rows() > 0) last = std::make_unique<CholeskyFloor>(matrix);
  return last.get();
}

void Forward(benchmark::State& state, const Case& c) {
  CholeskyFloor* const floor = FloorOf(c);
  Timings timings;
  SimulatorOptions options;
  options.timings = &timings;
  Simulator simulator(MakeScene(c), options);
  const double start = CpuSeconds();
  for (auto _ : state) {
    const Trajectory trajectory = simulator.Simulate(c.plan.num_frames);
    if (!trajectory.status.ok()) {
      state.SkipWithError(trajectory.status.Message().c_str());
      return;
    }
  }
  const double num_frames =
      static_cast<double>(state.iterations()) * (c.plan.num_frames - 1);
  const double milliseconds = 1e3 * (CpuSeconds() - start) / num_frames;
  state.counters["ms_per_frame"] = milliseconds;
  state.counters["vertices"] = c.plan.size * c.plan.size;
  state.counters["factorizations_per_frame"] =
      timings.Calls(TimedPart::kFactorization) / num_frames;
  if (floor == nullptr) return;
  const double floor_ms = floor->Milliseconds(0.15);
  state.counters["floor_ms"] = floor_ms;
  state.counters["ratio_to_floor"] = milliseconds / floor_ms;
  state.counters["factor_nonzeros"] = floor->num_factor_nonzeros();
}

void RegisterPreset(ScenePreset preset, const std::string& name) {
  for (const GridPlan& plan : kGrids) {
    for (const char* solver : kSolvers) {
      for (IntegrationMethod method : kMethods) {
        const Case c{preset, name, method, plan, solver};
        benchmark::RegisterBenchmark(
            CaseName("forward", c).c_str(),
            [c](benchmark::State& state) { Forward(state, c); })
            ->Unit(benchmark::kMillisecond)
            ->MeasureProcessCPUTime()
            ->Iterations(plan.num_rollouts);
      }
    }
  }
}

// The grids of cases.h have fewer frames the finer they are, all of them from rest: the
// cost of a cloth in full motion needs the same frames of all.
void RegisterGrowth() {
  constexpr int kFrames = 51;
  for (const GridPlan& plan : kGrids) {
    for (const char* solver : {"cg", "auto"}) {
      const Case c{ScenePreset::kSide,
                   "side",
                   IntegrationMethod::kLinearlyImplicitEuler,
                   {plan.size, kFrames, 1},
                   solver};
      benchmark::RegisterBenchmark(CaseName("growth", c).c_str(),
                                   [c](benchmark::State& state) { Forward(state, c); })
          ->Unit(benchmark::kMillisecond)
          ->MeasureProcessCPUTime()
          ->Iterations(1);
    }
  }
}

}  // namespace

void RegisterForward() {
  RegisterPreset(ScenePreset::kSide, "side");
  RegisterPreset(ScenePreset::kFlag, "flag");
  RegisterGrowth();
}

}  // namespace dpe::bench
