#include "experiments/fits/floor.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dpe/engine/scene_io.h"
#include "dpe/engine/simulator.h"
#include "dpe/estimation/observations.h"
#include "experiments/arguments.h"
#include "experiments/fits/job_scene.h"
#include "experiments/fits/minimize.h"

namespace dpe::experiments {
namespace {

// Decades around the mean of what the scene says, and grid points in each.
constexpr double kDecadesOfOne = 4.0, kDecadesOfTwo = 2.0;
constexpr int kPerDecadeOfOne = 50, kPerDecadeOfTwo = 6;
constexpr int kMaxMinima = 4;
constexpr double kLogTolerance = 1e-9;

// RMS as a function of log10(p / mean).
class MotionDistance {
 public:
  MotionDistance(const Scene& truth, const Scene& scene, int num_frames)
      : num_frames_(num_frames), simulator_(scene, OnlyEstimated()) {
    Simulator other(truth);
    const Trajectory motion = other.Simulate(num_frames);
    if (!motion.status.ok()) {
      throw SceneError("the scene's own motion cannot be simulated: " +
                       motion.status.Message());
    }
    target_ = ObserveAll(motion);
    centre_ = simulator_.layout().Extract(truth);
  }

  Eigen::VectorXd Parameters(const std::vector<double>& logarithms) const {
    Eigen::VectorXd parameters = centre_;
    for (Eigen::Index i = 0; i < parameters.size(); ++i) {
      parameters[i] *= std::pow(10.0, logarithms[static_cast<size_t>(i)]);
    }
    return parameters;
  }

  double operator()(const std::vector<double>& logarithms) {
    ++evaluations_;
    const Rollout rollout = simulator_.Run(Parameters(logarithms), num_frames_);
    if (!rollout.status().ok()) return std::numeric_limits<double>::infinity();
    return RmsPositionError(rollout.trajectory(), target_, num_frames_);
  }

  int size() const { return static_cast<int>(centre_.size()); }
  int evaluations() const { return evaluations_; }

 private:
  static SimulatorOptions OnlyEstimated() {
    SimulatorOptions options;
    options.only_estimated_objects = true;
    options.memory_limit_bytes = 0;  // no derivatives are asked for
    return options;
  }

  const int num_frames_;
  Simulator simulator_;
  Observations target_;
  Eigen::VectorXd centre_;
  int evaluations_ = 0;
};

// The grid's extent: one value alone may be far off, and of two the second (stiffness)
// likewise; a mean mass is not.
std::vector<double> Decades(int size) {
  if (size == 1) return {kDecadesOfOne};
  return {kDecadesOfTwo, kDecadesOfTwo + 1.0};
}

Minimum Refine(const Objective& objective, const Minimum& start, double spacing) {
  if (start.at.size() == 1) {
    return GoldenSection(objective, start.at[0] - spacing, start.at[0] + spacing,
                         kLogTolerance);
  }
  return NelderMead(objective, start.at, 0.5 * spacing, 1e-10);
}

Record Run(const Job& job) {
  std::vector<std::string> known = {"settings", "frames"};
  known.insert(known.end(), JobSceneArguments().begin(), JobSceneArguments().end());
  RequireKnownArguments(job, known);
  const JobScenes paths(job, /*is_required=*/true);
  const Scene truth = LoadScene(paths.paths()[0]);
  Scene scene = truth;
  ApplySettings(job.Text("settings", ""), &scene);
  MotionDistance distance(truth, scene, job.Integer("frames", truth.num_frames));
  const int size = distance.size();
  if (size < 1 || size > 2) {
    throw SceneError("settings: \"" + job.Text("settings", "") + "\" has " +
                     std::to_string(size) + " values; a floor is of one or two");
  }
  const Objective objective = [&](const std::vector<double>& p) { return distance(p); };
  const int per_decade = size == 1 ? kPerDecadeOfOne : kPerDecadeOfTwo;
  std::vector<double> low, high;
  std::vector<int> count;
  for (const double decades : Decades(size)) {
    low.push_back(-decades);
    high.push_back(decades);
    count.push_back(static_cast<int>(2 * decades) * per_decade + 1);
  }
  const std::vector<Minimum> starts =
      GridMinima(objective, low, high, count, kMaxMinima);
  if (starts.empty()) throw SceneError("no value of the grid can be simulated");
  Minimum best = starts[0];
  for (const Minimum& start : starts) {
    const Minimum refined = Refine(objective, start, 1.0 / per_decade);
    if (refined.value < best.value) best = refined;
  }
  Record row;
  row.Set("floor_m", best.value);
  const Eigen::VectorXd values = distance.Parameters(best.at);
  for (int i = 0; i < size; ++i) {
    row.Set("value_" + std::to_string(i + 1), values[i]);
  }
  row.Set("minima", static_cast<int>(starts.size()));
  row.Set("evaluations", distance.evaluations());
  return row;
}

}  // namespace

JobKind FloorKind() {
  return {"floor", "the least RMS that one or two values for a whole cloth can reach",
          Run};
}

}  // namespace dpe::experiments
