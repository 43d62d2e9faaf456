// One iteration of Levenberg-Marquardt, all told: a trial step, its rollout and, if it
// is taken, the Jacobian there and its reduction.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <string>

#include "benchmarks.h"
#include "cases.h"
#include "dpe/engine/simulator.h"
#include "dpe/engine/timings.h"
#include "dpe/estimation/estimator.h"
#include "dpe/estimation/observations.h"
#include "resource_usage.h"

namespace dpe::bench {
namespace {

constexpr int kIterations = 3;

double WallSeconds() {
  return std::chrono::duration<double>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

// The quickest iteration of each kind, from one progress report to the next.
class IterationClock {
 public:
  void Report(const IterationReport& report) {
    const double cpu = CpuSeconds(), wall = WallSeconds();
    if (report.iteration > 0 && report.step_accepted) {
      accepted_cpu = std::min(accepted_cpu, cpu - last_cpu_);
      accepted_wall = std::min(accepted_wall, wall - last_wall_);
      ++num_accepted;
    } else if (report.iteration > 0) {
      rejected_cpu = std::min(rejected_cpu, cpu - last_cpu_);
    }
    last_cpu_ = cpu;
    last_wall_ = wall;
  }

  double accepted_cpu = std::numeric_limits<double>::infinity();  // s
  double accepted_wall = std::numeric_limits<double>::infinity();
  double rejected_cpu = std::numeric_limits<double>::infinity();
  int num_accepted = 0;

 private:
  double last_cpu_ = 0.0, last_wall_ = 0.0;
};

void LmIteration(benchmark::State& state, const Case& c, int num_threads) {
  const MemoryPeak memory;
  Scene scene = MakeScene(c);
  ApplySettings("nL", &scene);
  const Trajectory motion = Simulator(scene).Simulate(c.plan.num_frames);
  Timings timings;
  IterationClock clock;
  EstimatorOptions options;
  options.solver = SolverType::kLevenbergMarquardt;
  options.init = InitMethod::kScene;
  options.init_perturbation = 0.01;
  options.max_iterations = kIterations;
  options.num_threads = num_threads;
  options.timings = &timings;
  options.progress = [&clock](const IterationReport& report) { clock.Report(report); };
  EstimatorSummary summary;
  for (auto _ : state) summary = Estimate(scene, ObserveAll(motion), options);
  if (clock.num_accepted == 0) {
    state.SkipWithError("no step was accepted");
    return;
  }
  const double per_jacobian = 1e3 / summary.jacobian_evaluations;
  state.counters["ms"] = 1e3 * clock.accepted_cpu;
  state.counters["wall_ms"] = 1e3 * clock.accepted_wall;
  state.counters["rejected_ms"] = 1e3 * clock.rejected_cpu;
  state.counters["jacobian_wall_ms"] =
      per_jacobian * timings.Seconds(TimedPart::kDerivatives);
  state.counters["least_squares_wall_ms"] =
      per_jacobian * timings.Seconds(TimedPart::kLeastSquares);
  state.counters["parameters"] = static_cast<double>(summary.parameters.size());
  state.counters["frames"] = c.plan.num_frames;
  state.counters["threads"] = num_threads;
  state.counters["accepted"] = clock.num_accepted;
  state.counters["peak_mib"] = memory.Mebibytes();
}

}  // namespace

void RegisterLmIteration() {
  for (IntegrationMethod method : kMethods) {
    for (const int num_threads : {1, 2}) {
      const Case c{ScenePreset::kSide, "side", method, {12, 100, 1}};
      benchmark::RegisterBenchmark(
          (CaseName("lm_iteration", c) + "/threads:" + std::to_string(num_threads))
              .c_str(),
          [c, num_threads](benchmark::State& state) {
            LmIteration(state, c, num_threads);
          })
          ->Unit(benchmark::kMillisecond)
          ->MeasureProcessCPUTime()
          ->Iterations(1);
    }
  }
}

}  // namespace dpe::bench
