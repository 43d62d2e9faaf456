#include "dpe/estimation/estimator.h"

#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <sstream>

#include "dpe/engine/parameters.h"
#include "dpe/estimation/trajectory_problem.h"
#include "fit_setup.h"
#include "optimizers.h"
#include "starting_point.h"
#include "stop_control.h"
#include "summary_blocks.h"

namespace dpe {
namespace {

// Repetitions of a fit from better trial points.
constexpr int kMaxBasins = 3;

class Fit {
 public:
  Fit(const Scene& scene, const Observations& observations,
      const EstimatorOptions& options)
      : scene_(scene),
        options_(options),
        observations_(FirstFrames(
            observations, NumFramesToFit(scene, observations, options.num_frames))),
        stop_(options.max_seconds, options.interrupted) {
    const Scene blank = WithoutEstimatedValues(scene);
    summary_.num_frames = observations_.num_frames();
    TrajectoryCosts costs =
        MakePositionCosts(blank, observations_, summary_.num_frames);
    if (costs.empty()) {
      throw SceneError(
          "no free vertex of an estimated object is observed after frame 0");
    }
    TrajectoryEvaluatorOptions evaluator_options;
    evaluator_options.jacobian = options.jacobian;
    evaluator_options.num_threads = options.num_threads;
    evaluator_options.memory_limit_bytes = options.memory_limit_bytes;
    evaluator_options.timings = options.timings;
    evaluator_options.interrupted = [this] { return stop_.Poll(); };
    problem_ =
        std::make_unique<TrajectoryProblem>(blank, std::move(costs), evaluator_options);
    rms_scale_ = std::make_unique<RmsScale>(*evaluator()->simulator(), observations_);
    context_.problem = problem_.get();
    context_.options = &options_;
    context_.stop = &stop_;
    context_.converged_cost = rms_scale_->CostOf(options.rms_tolerance);
    context_.rms_of_cost = [this](double cost) { return rms_scale_->Rms(cost); };
  }

  EstimatorSummary Run() {
    ChooseSolver();
    if (Start()) {
      Optimise();
      CheckForBetterBasins();
    } else {
      ExplainFailedStart();
    }
    Finish();
    return summary_;
  }

 private:
  TrajectoryEvaluator* evaluator() { return problem_->evaluator(); }

  bool HasFewParameters() {
    return evaluator()->num_parameters() <= options_.max_checked_parameters;
  }

  void ChooseSolver() {
    const double bytes = 8.0 * evaluator()->num_residuals() *
                         static_cast<double>(evaluator()->num_parameters());
    const bool fits = bytes <= options_.max_lm_jacobian_bytes;
    std::ostringstream reason;
    reason.precision(3);
    if (options_.solver == SolverType::kAuto) {
      use_lm_ = fits;
      reason << "auto: the Jacobian of " << evaluator()->num_residuals()
             << " residuals by " << evaluator()->num_parameters()
             << " parameters takes " << bytes / 1e6 << " MB, "
             << (fits ? "within" : "above") << " the limit of "
             << options_.max_lm_jacobian_bytes / 1e6 << " MB for LM";
    } else {
      use_lm_ = options_.solver == SolverType::kLevenbergMarquardt;
      reason << "asked for";
    }
    summary_.solver = use_lm_ ? "lm" : "lbfgs";
    summary_.solver_reason = reason.str();
  }

  // Finds a start that can be simulated and makes it the current point.
  bool Start() {
    start_ = FindStartingPoint(scene_, observations_, options_, &stop_, evaluator());
    TryStart();
    if (!start_.ok && HasFewParameters() && start_.init != "screen" &&
        !stop_.stopped()) {
      summary_.notes.push_back("the starting point (" + start_.init +
                               ") cannot be simulated: " + start_.message +
                               "; the screen's best trial point takes its place");
      start_ = ScreenStartingPoints(&stop_, evaluator());
      TryStart();
    }
    if (!start_.ok) return false;
    summary_.initial_cost = evaluator()->cost();
    summary_.initial_rms = rms_scale_->Rms(summary_.initial_cost);
    summary_.jacobian = use_lm_ ? evaluator()->JacobianMethodName() : "gradient";
    return true;
  }

  void TryStart() {
    summary_.init = start_.init;
    summary_.notes.insert(summary_.notes.end(), start_.notes.begin(),
                          start_.notes.end());
    if (!start_.ok) return;
    PerturbStart();
    NormaliseStart();
    problem_->set_coordinates(start_.coordinates);
    start_.ok = evaluator()->Evaluate(start_.coordinates);
    start_.message = evaluator()->message();
  }

  void PerturbStart() {
    if (options_.init_perturbation == 0.0) return;
    std::mt19937_64 generator(options_.seed);
    std::normal_distribution<double> normal;
    Eigen::VectorXd parameters = evaluator()->map().ToParameters(start_.coordinates);
    for (double& value : parameters) {
      value *= std::exp(options_.init_perturbation * normal(generator));
    }
    start_.coordinates = evaluator()->map().ToCoordinates(parameters);
  }

  void NormaliseStart() {
    // Inverse dynamics has done so itself, and said so.
    const bool is_done = start_.init == "inverse_dynamics";
    if (is_done && options_.init_perturbation == 0.0) return;
    Eigen::VectorXd parameters = evaluator()->map().ToParameters(start_.coordinates);
    const std::vector<std::string> notes =
        NormaliseScale(scene_, problem_->layout(), FreeMass(scene_), &parameters);
    if (notes.empty()) return;
    if (!is_done) {
      summary_.notes.insert(summary_.notes.end(), notes.begin(), notes.end());
    }
    start_.coordinates = evaluator()->map().ToCoordinates(parameters);
  }

  void ExplainFailedStart() {
    if (stop_.stopped()) {
      summary_.termination = stop_.was_interrupted() ? Termination::kInterrupted
                                                     : Termination::kMaxSeconds;
      summary_.message = "stopped before the starting point was simulated";
      return;
    }
    summary_.termination = Termination::kStartFailed;
    summary_.message = "the starting point (" + start_.init +
                       ") cannot be simulated: " + start_.message;
    if (start_.init != "screen") {
      summary_.message += "; try --init=screen, which looks for one that can";
    }
  }

  void Optimise() {
    if (evaluator()->cost() > context_.converged_cost) {
      Minimise();
      return;
    }
    IterationReport report;
    report.cost = evaluator()->cost();
    context_.Report(report);
    summary_.termination = Termination::kConverged;
    summary_.message =
        "the starting point is the answer to the level of rounding (rms_tolerance)";
  }

  void Minimise() {
    const OptimizerResult result =
        use_lm_ ? MinimizeByLevenbergMarquardt(&context_) : MinimizeByLbfgs(&context_);
    summary_.termination = result.termination;
    summary_.message = result.message;
  }

  // With a handful of parameters the whole range can be looked at, so that a local
  // minimum or a plateau is not taken for the answer.
  void CheckForBetterBasins() {
    for (int round = 0; round < kMaxBasins && HasFewParameters(); ++round) {
      const double cost_before = evaluator()->best_cost();
      if (!summary_.usable() || cost_before <= context_.converged_cost) return;
      const Eigen::VectorXd better = FindBetterTrialPoint(&stop_, evaluator());
      if (better.size() == 0) return;
      problem_->set_coordinates(better);
      Minimise();
      std::ostringstream note;
      note << "the fit had converged to RMS " << rms_scale_->Rms(cost_before)
           << " m; log-spaced trial values showed a better basin, from which it was "
              "repeated";
      summary_.notes.push_back(note.str());
    }
  }

  void Finish() {
    const bool has_result = evaluator()->best_coordinates().size() > 0;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    summary_.parameters = evaluator()->map().ToParameters(
        has_result ? evaluator()->best_coordinates() : problem_->coordinates());
    // Steps of the optimiser may have moved along the scale, which costs nothing.
    NormaliseScale(scene_, problem_->layout(), FreeMass(scene_), &summary_.parameters);
    summary_.final_cost = has_result ? evaluator()->best_cost() : nan;
    summary_.final_rms = rms_scale_->Rms(summary_.final_cost);
    if (!has_result) summary_.initial_cost = summary_.initial_rms = nan;
    summary_.iterations = context_.num_iterations;
    summary_.evaluations = evaluator()->num_rollouts();
    summary_.jacobian_evaluations = evaluator()->num_derivative_passes();
    summary_.scene = scene_;
    problem_->layout().Insert(summary_.parameters, &summary_.scene);
    summary_.blocks = MakeEstimatedBlocks(problem_->layout(), summary_.parameters);
    summary_.wall_time_s = stop_.Seconds();
  }

  const Scene& scene_;
  const EstimatorOptions options_;
  const Observations observations_;
  StopControl stop_;
  std::unique_ptr<TrajectoryProblem> problem_;
  std::unique_ptr<RmsScale> rms_scale_;
  OptimizerContext context_;
  StartingPoint start_;
  EstimatorSummary summary_;
  bool use_lm_ = true;
};

}  // namespace

EstimatorSummary Estimate(const Scene& scene, const Observations& observations,
                          const EstimatorOptions& options) {
  return Fit(scene, observations, options).Run();
}

}  // namespace dpe
