#include "fit_problem.h"

#include <limits>
#include <sstream>
#include <utility>

#include "fit_setup.h"

namespace dpe {

FitProblem::FitProblem(const Scene& blank, const Observations& observations,
                       int num_frames, const EstimatorOptions& options,
                       StopControl* stop)
    : num_frames_(num_frames),
      observations_(CutFrames(observations, 0, num_frames)),
      best_rms_(std::numeric_limits<double>::quiet_NaN()) {
  PositionCostOptions cost_options;
  cost_options.loss = options.loss;
  cost_options.loss_scale = options.loss_scale;
  TrajectoryCosts costs =
      MakePositionCosts(blank, observations_, num_frames, cost_options);
  if (costs.empty()) {
    throw SceneError("no free vertex of an estimated object is observed after frame 0");
  }
  TrajectoryEvaluatorOptions evaluator_options;
  evaluator_options.jacobian = options.jacobian;
  evaluator_options.num_threads = options.num_threads;
  evaluator_options.memory_limit_bytes = options.memory_limit_bytes;
  evaluator_options.timings = options.timings;
  evaluator_options.priors = options.priors;
  evaluator_options.smoothness = options.smoothness;
  evaluator_options.interrupted = [stop] { return stop->Poll(); };
  evaluator_options.improved = [this] {
    best_rms_ = RmsPositionError(evaluator()->trajectory(), observations_, num_frames_);
  };
  problem_ =
      std::make_unique<TrajectoryProblem>(blank, std::move(costs), evaluator_options);
  noise_is_known_ = NoiseIsKnown(blank, observations_);
  if (!noise_is_known_ && !(options.priors.empty() && options.smoothness.empty())) {
    throw SceneError(
        "priors and smoothness are weighed against the noise of the target, which is "
        "not known: give its standard deviation (--sigma, or sigma in the target)");
  }
  converged_cost_ = CostOfRms(blank, observations_, options.rms_tolerance);
}

bool FitProblem::IsAtRounding() const {
  return problem_->evaluator()->best_cost() <= converged_cost_;
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
