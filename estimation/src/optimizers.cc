#include "optimizers.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <utility>

#include "levenberg_marquardt.h"

namespace dpe {
namespace {

// L-BFGS is restarted from its best point when a line search finds no decrease; it has
// converged when a restart gains less than this fraction of the cost.
constexpr double kRestartGain = 1e-6;

constexpr int kDefaultLmIterations = 200;
constexpr int kDefaultLbfgsIterations = 5000;
constexpr int kLbfgsRank = 50;

// Reports iterations and ends the solve when there is a reason to.
class ProgressCallback : public ceres::IterationCallback {
 public:
  // @param damping  of the trust region; 1 where it is not uniform
  explicit ProgressCallback(OptimizerContext* context, double damping = 1.0)
      : context_(context),
        damping_(damping),
        first_iteration_(context->num_iterations) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& s) override {
    // A later solve's iteration 0 is the point that the one before ended at.
    if (s.iteration > 0 || first_iteration_ == 0) {
      context_->num_iterations = first_iteration_ + s.iteration;
      IterationReport report;
      report.iteration = context_->num_iterations;
      // A rejected step's own cost would only confuse; it may be infinite.
      report.cost =
          s.step_is_successful ? s.cost : context_->problem()->evaluator()->best_cost();
      report.step_norm = s.step_norm;
      report.gradient_max_norm = s.gradient_max_norm;
      report.step_accepted = s.step_is_successful;
      context_->Report(report);
      if (s.iteration > 0 && s.step_is_successful) {
        context_->last_radius = s.trust_region_radius / damping_;
        if (context_->accepted) context_->accepted(*context_, context_->last_radius);
      }
    }
    if (context_->stop->Poll() || context_->fit->IsAtRounding()) {
      return ceres::SOLVER_TERMINATE_SUCCESSFULLY;
    }
    return ceres::SOLVER_CONTINUE;
  }

 private:
  OptimizerContext* context_;
  double damping_;
  int first_iteration_;
};

// Goes back to the best point that was evaluated: Ceres leaves the parameters where
// they were when a solve ends in a failure.
void RestoreBest(TrajectoryProblem* problem) {
  problem->set_coordinates(problem->evaluator()->best_coordinates());
}

OptimizerResult Explain(const OptimizerContext& context, ceres::TerminationType type,
                        const std::string& message) {
  if (context.stop->was_interrupted()) {
    return {Termination::kInterrupted, "interrupted by the user"};
  }
  if (context.stop->ran_out_of_time()) {
    return {Termination::kMaxSeconds, "the time limit was reached"};
  }
  if (context.fit->IsAtRounding()) {
    return {Termination::kConverged,
            "the error has fallen to the level of rounding (rms_tolerance)"};
  }
  switch (type) {
    case ceres::CONVERGENCE:
    case ceres::USER_SUCCESS:
      return {Termination::kConverged, message};
    case ceres::NO_CONVERGENCE:
      return {Termination::kMaxIterations, "the iteration limit was reached"};
    default:
      return {Termination::kNumericalFailure, message};
  }
}

// What is left of the limit: the user's over everything, the default for each horizon.
int MaxIterations(const OptimizerContext& context, int default_value) {
  const int limit = context.options->max_iterations;
  const int last = limit >= 0 ? limit : default_value + context.first_iteration;
  return std::max(0, last - context.num_iterations);
}

// With one unknown per element, many of them hardly move the motion. Damping relative
// to the columns of J lets these wander by factors of thousands at every step, which no
// linear model describes; the same damping for all makes a step a change of the
// logarithms that is small where nothing asks for it:
//
//   (J^T J + d / radius I) step = -J^T r,   d = max_j |J_j|^2 over elements.
//
// @return d; 1 without such unknowns, where nothing is changed
double SetUniformDamping(TrajectoryProblem* problem, ceres::Solver::Options* solver) {
  TrajectoryEvaluator* evaluator = problem->evaluator();
  if (!evaluator->EvaluateJacobian()) return 1.0;
  const Eigen::VectorXd squares = evaluator->JacobianColumnSquares();
  double largest = 0.0;
  for (const ParameterBlock& block : evaluator->layout().blocks()) {
    if (block.mode != ParameterMode::kLocal) continue;
    largest = std::max(largest, squares.segment(block.offset, block.size).maxCoeff());
  }
  if (!(largest > 0.0) || !std::isfinite(largest)) return 1.0;
  solver->jacobi_scaling = false;
  solver->min_lm_diagonal = largest;
  solver->max_lm_diagonal = largest;
  return largest;
}

OptimizerResult SolveByLevenbergMarquardt(OptimizerContext* context) {
  const EstimatorOptions& options = *context->options;
  ceres::Solver::Options solver = LevenbergMarquardtOptions();
  solver.max_num_iterations = MaxIterations(*context, kDefaultLmIterations);
  const double damping = SetUniformDamping(context->problem(), &solver);
  if (context->initial_radius > 0.0) {
    solver.initial_trust_region_radius =
        std::min(context->initial_radius * damping, solver.max_trust_region_radius);
    context->initial_radius = 0.0;
  }
  context->last_radius = 0.0;
  solver.function_tolerance = options.function_tolerance;
  solver.gradient_tolerance = options.gradient_tolerance;
  solver.parameter_tolerance = options.parameter_tolerance;
  solver.num_threads = options.num_threads;
  ProgressCallback callback(context, damping);
  solver.callbacks.push_back(&callback);
  ceres::Solver::Summary summary;
  const std::unique_ptr<ceres::Problem> reduced =
      context->problem()->NewReducedLeastSquares();
  ceres::Solve(solver, reduced ? reduced.get() : context->problem()->least_squares(),
               &summary);
  if (options.timings != nullptr) {
    options.timings->Add(
        TimedPart::kLeastSquares,
        std::chrono::nanoseconds(
            std::llround(1e9 * std::max(0.0, summary.linear_solver_time_in_seconds))));
  }
  RestoreBest(context->problem());
  return Explain(*context, summary.termination_type, summary.message);
}

OptimizerResult MinimizeByLevenbergMarquardt(OptimizerContext* context) {
  const bool is_carried = context->initial_radius > 0.0;
  OptimizerResult result = SolveByLevenbergMarquardt(context);
  // A radius from elsewhere may be so small that no step seems worth taking.
  const bool has_moved = context->last_radius > 0.0;
  if (!is_carried || has_moved || result.termination != Termination::kConverged ||
      context->fit->IsAtRounding()) {
    return result;
  }
  return SolveByLevenbergMarquardt(context);
}

OptimizerResult MinimizeByLbfgs(OptimizerContext* context) {
  const EstimatorOptions& options = *context->options;
  ceres::GradientProblemSolver::Options solver;
  solver.line_search_direction_type = ceres::LBFGS;
  solver.max_lbfgs_rank = kLbfgsRank;
  solver.function_tolerance = options.function_tolerance;
  solver.gradient_tolerance = options.gradient_tolerance;
  solver.parameter_tolerance = options.parameter_tolerance;
  solver.logging_type = ceres::SILENT;
  TrajectoryEvaluator* evaluator = context->problem()->evaluator();
  const ceres::GradientProblem problem(context->problem()->NewFirstOrderFunction());
  while (true) {
    solver.max_num_iterations = MaxIterations(*context, kDefaultLbfgsIterations);
    ProgressCallback callback(context);
    solver.callbacks = {&callback};
    const double cost_before = evaluator->best_cost();
    Eigen::VectorXd coordinates = context->problem()->coordinates();
    ceres::GradientProblemSolver::Summary summary;
    ceres::Solve(solver, problem, coordinates.data(), &summary);
    RestoreBest(context->problem());
    OptimizerResult result =
        Explain(*context, summary.termination_type, summary.message);
    if (result.termination != Termination::kNumericalFailure) return result;
    if (!(evaluator->best_cost() < (1.0 - kRestartGain) * cost_before)) {
      result.termination = Termination::kConverged;
      result.message = "no step along the gradient lowers the cost any more";
      return result;
    }
  }
}

}  // namespace

void OptimizerContext::Report(IterationReport report) const {
  if (!options->progress) return;
  report.rms = fit->best_rms();
  report.num_frames = fit->num_frames();
  report.seconds = stop->Seconds();
  options->progress(report);
}

OptimizerResult Minimize(bool use_lm, OptimizerContext* context) {
  return use_lm ? MinimizeByLevenbergMarquardt(context) : MinimizeByLbfgs(context);
}

}  // namespace dpe
