#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "dpe/engine/simulator.h"
#include "experiments/tradeoff/candidate.h"
#include "experiments/tradeoff/jobs.h"
#include "experiments/tradeoff/measures.h"
#include "experiments/tradeoff/reference.h"

namespace dpe::experiments::tradeoff {
namespace {

constexpr int kRepeats = 1;  // beside the first rollout
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

void SetErrors(const Candidate& candidate, const Scene& scene,
               const Trajectory& trajectory, Record* row) {
  const Eigen::MatrixXd difference =
      trajectory.positions[0] - CachedReference(scene, candidate.frames).positions;
  for (int horizon : kHorizons) {
    if (horizon >= candidate.frames) continue;
    const MotionError error = ErrorOver(difference, scene, horizon);
    row->Set("rms_" + std::to_string(horizon) + "_m", error.rms);
    row->Set("max_" + std::to_string(horizon) + "_m", error.max);
  }
}

}  // namespace

Record RunSimulationJob(const Job& job) {
  const Candidate candidate = CandidateFromRecord(job);
  const Scene scene = CandidateScene(candidate);
  Timings timings;
  SimulatorOptions options = CandidateOptions(candidate);
  options.timings = &timings;
  Simulator counted(scene, options);
  const double start = CpuSeconds();
  const Trajectory trajectory = counted.Simulate(candidate.frames);
  const double first = CpuSeconds() - start;
  const bool ok = trajectory.status.ok();
  Record row;
  row.Set("stopped", ok ? "" : trajectory.status.Message());
  row.Set("steps_per_frame", scene.steps_per_frame);
  // Horizons before a failure are errors, those after it NaN.
  SetErrors(candidate, scene, trajectory, &row);
  if (ok) SetWork(timings, candidate.frames, &row);
  const GradientErrors errors =
      ok ? MeasureGradient(candidate, job.Flag("difference", false))
         : GradientErrors{kNan, kNan, kNan};
  row.Set("gradient_error", errors.solve);
  row.Set("difference_error", errors.difference);
  if (!ok) return row;
  row.Set("kept_mib", errors.kept_mib);
  Simulator simulator(scene, CandidateOptions(candidate));
  const double seconds =
      LeastCpuSeconds(kRepeats, [&] { simulator.Simulate(candidate.frames); });
  row.Set("frame_s", std::min(first, seconds) / (candidate.frames - 1));
  return row;
}

}  // namespace dpe::experiments::tradeoff
