#include "fit_problem.h"

#include <limits>
#include <sstream>
#include <utility>

namespace dpe {

FitProblem::FitProblem(std::vector<FitCapture> captures,
                       const EstimatorOptions& options, StopControl* stop)
    : captures_(std::move(captures)),
      num_frames_(MostFrames(captures_)),
      best_rms_(std::numeric_limits<double>::quiet_NaN()),
      best_rms_of_(captures_.size(), best_rms_) {
  std::vector<TrajectorySegment> segments;
  bool is_anything_observed = false;
  for (const FitCapture& capture : captures_) {
    TrajectorySegment segment;
    segment.scene = capture.blank;
    segment.costs = MakePositionCosts(capture.blank, capture.observations,
                                      capture.num_frames, CostOptionsOf(options));
    is_anything_observed |= !segment.costs.empty();
    segments.push_back(std::move(segment));
    noise_is_known_ |= NoiseIsKnown(capture.blank, capture.observations);
    converged_cost_ +=
        CostOfRms(capture.blank, capture.observations, options.rms_tolerance);
  }
  if (!is_anything_observed) {
    throw SceneError("no free vertex of an estimated object is observed after frame 0");
  }
  if (!noise_is_known_ && !(options.priors.empty() && options.smoothness.empty())) {
    throw SceneError(
        "priors and smoothness are weighed against the noise of the target, which is "
        "not known: give its standard deviation (--sigma, or sigma in the target)");
  }
  TrajectoryEvaluatorOptions evaluator_options = EvaluatorOptionsOf(options, stop);
  evaluator_options.priors = options.priors;
  evaluator_options.smoothness = options.smoothness;
  evaluator_options.own_wind = true;
  evaluator_options.improved = [this] { MeasureErrors(); };
  problem_ = std::make_unique<TrajectoryProblem>(
      std::move(segments), std::vector<SegmentLink>(), evaluator_options);
}

void FitProblem::MeasureErrors() {
  PositionErrors all;
  for (size_t c = 0; c < captures_.size(); ++c) {
    const Trajectory& trajectory = evaluator()->trajectory(static_cast<int>(c));
    PositionErrors own;
    AddPositionErrors(trajectory, captures_[c].observations, captures_[c].num_frames,
                      &own);
    best_rms_of_[c] = own.Rms();
    all.sum += own.sum;
    all.count += own.count;
  }
  best_rms_ = all.Rms();
}

bool FitProblem::IsAtRounding() const {
  return problem_->evaluator()->best_cost() <= converged_cost_;
}

PositionCostOptions CostOptionsOf(const EstimatorOptions& options) {
  PositionCostOptions cost_options;
  cost_options.loss = options.loss;
  cost_options.loss_scale = options.loss_scale;
  return cost_options;
}

TrajectoryEvaluatorOptions EvaluatorOptionsOf(const EstimatorOptions& options,
                                              StopControl* stop) {
  TrajectoryEvaluatorOptions evaluator_options;
  evaluator_options.jacobian = options.jacobian;
  evaluator_options.num_threads = options.num_threads;
  evaluator_options.memory_limit_bytes = options.memory_limit_bytes;
  evaluator_options.timings = options.timings;
  evaluator_options.interrupted = [stop] { return stop->Poll(); };
  return evaluator_options;
}

double JacobianBytes(const TrajectoryEvaluator& evaluator) {
  return 8.0 * evaluator.num_residuals() *
         static_cast<double>(evaluator.num_parameters());
}

SolverChoice ChooseSolver(const TrajectoryEvaluator& evaluator,
                          const EstimatorOptions& options) {
  const double bytes = JacobianBytes(evaluator);
  const bool fits = bytes <= options.max_lm_jacobian_bytes;
  if (options.solver != SolverType::kAuto) {
    return {options.solver == SolverType::kLevenbergMarquardt, "asked for"};
  }
  std::ostringstream reason;
  reason.precision(3);
  reason << "auto: the Jacobian of " << evaluator.num_residuals() << " residuals by "
         << evaluator.num_parameters() << " parameters takes " << bytes / 1e6 << " MB, "
         << (fits ? "within" : "above") << " the limit of "
         << options.max_lm_jacobian_bytes / 1e6 << " MB for LM";
  return {fits, reason.str()};
}

}  // namespace dpe
