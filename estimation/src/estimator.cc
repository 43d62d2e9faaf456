#include "dpe/estimation/estimator.h"

#include <cmath>
#include <limits>
#include <random>
#include <sstream>
#include <utility>
#include <vector>

#include "better_basins.h"
#include "dpe/engine/parameters.h"
#include "fit_checkpoints.h"
#include "fit_problem.h"
#include "fit_setup.h"
#include "fit_summary.h"
#include "fit_uncertainty.h"
#include "held_out_weights.h"
#include "horizon.h"
#include "optimizers.h"
#include "prior_rows.h"
#include "shooting_start.h"
#include "starting_point.h"
#include "stop_control.h"
#include "summary_blocks.h"

namespace dpe {
namespace {

class Fit {
 public:
  Fit(const std::vector<CaptureView>& captures, const EstimatorOptions& options)
      : captures_(captures),
        options_(options),
        checkpoints_(captures, options_),
        stop_(options.max_seconds, options.interrupted,
              resumed() != nullptr ? resumed()->seconds : 0.0),
        fit_(PrepareCaptures(captures, options.num_frames), options_, &stop_) {
    RequireOneMass(captures);
    if (options.horizon == Horizon::kShooting && captures.size() > 1) {
      throw SceneError("horizon shooting is for one capture, and there are " +
                       std::to_string(captures.size()) +
                       "; accepted with several are auto, full and grow");
    }
    context_.fit = &fit_;
    context_.options = &options_;
    context_.stop = &stop_;
    context_.accepted = [this](const OptimizerContext& context, double radius) {
      SaveCheckpoint(context.fit == &fit_ ? "fit" : "grow", context, radius);
    };
    summary_.num_frames = fit_.num_frames();
    summary_.initial_cost = summary_.initial_rms =
        std::numeric_limits<double>::quiet_NaN();
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
  TrajectoryEvaluator* evaluator() { return fit_.evaluator(); }
  TrajectoryProblem* problem() { return fit_.problem(); }

  bool HasFewParameters() {
    return evaluator()->num_parameters() <= options_.max_checked_parameters;
  }

  void ChooseSolver() {
    const SolverChoice choice = dpe::ChooseSolver(*evaluator(), options_);
    use_lm_ = choice.is_lm;
    summary_.solver = use_lm_ ? "lm" : "lbfgs";
    summary_.solver_reason = choice.reason;
  }

  // What to continue; null: nothing.
  const Checkpoint* resumed() const { return checkpoints_.resumed(); }

  void SaveCheckpoint(const char* stage, const OptimizerContext& context,
                      double radius) {
    checkpoints_.Save(stage, context, radius, start_.coordinates, summary_);
  }

  // Makes a start that can be simulated the current point: what is found, or where an
  // earlier run was.
  bool Start() {
    if (resumed() != nullptr) {
      checkpoints_.RequireCoordinates(evaluator()->num_parameters());
      Resume(*resumed());
    } else {
      FindStart();
    }
    if (!start_.ok) return false;
    summary_.jacobian = use_lm_ ? evaluator()->JacobianMethodName() : "gradient";
    // Where the fit is over on the way here, it is to be continued there.
    if (!context_.is_over()) SaveCheckpoint("fit", context_, context_.initial_radius);
    return true;
  }

  void Resume(const Checkpoint& checkpoint) {
    start_.init = summary_.init = checkpoint.init;
    summary_.notes = checkpoint.notes;
    summary_.initial_cost = checkpoint.initial_cost;
    summary_.initial_rms = checkpoint.initial_rms;
    start_.coordinates = checkpoint.start;
    context_.num_iterations = checkpoint.iterations;
    if (checkpoint.stage == "fit") {
      context_.first_iteration = checkpoint.first_iteration;
      context_.initial_radius = checkpoint.radius;
      summary_.horizons = context_.horizons = checkpoint.horizons;
      GoTo(checkpoint.coordinates);
      return;
    }
    GoTo(checkpoint.start);
    Approach(checkpoint.stage == "grow" ? &checkpoint : nullptr);
    ReplaceFailedStart();
  }

  void FindStart() {
    start_ = FindStartingPoint(
        {&captures_, &fit_.captures(), &options_, &stop_, evaluator()});
    TryStart();
    if (start_.coordinates.size() > 0) SaveCheckpoint("start", context_, 0.0);
    Approach(nullptr);
    ReplaceFailedStart();
  }

  void ReplaceFailedStart() {
    if (!start_.ok && HasFewParameters() && start_.init != "screen" &&
        !stop_.stopped()) {
      summary_.notes.push_back("the starting point (" + start_.init +
                               ") cannot be simulated: " + start_.message +
                               "; the screen's best trial point takes its place");
      start_ = ScreenStartingPoints(&stop_, evaluator());
      TryStart();
    }
  }

  void TryStart() {
    summary_.init = start_.init;
    summary_.notes.insert(summary_.notes.end(), start_.notes.begin(),
                          start_.notes.end());
    if (!start_.ok) return;
    PerturbStart();
    NormaliseStart();
    GoTo(start_.coordinates);
    if (start_.ok) RecordStart();
  }

  void GoTo(const Eigen::VectorXd& coordinates) {
    problem()->set_coordinates(coordinates);
    start_.ok = evaluator()->Evaluate(coordinates);
    start_.message = evaluator()->message();
  }

  void RecordStart() {
    summary_.initial_cost = evaluator()->cost();
    summary_.initial_rms = fit_.best_rms();
  }

  // A start from inverse dynamics has seen the whole motion if all captures could be
  // used for it, one that was given is somebody's answer.
  bool ShouldGrow() {
    if (options_.horizon != Horizon::kAuto) {
      return options_.horizon == Horizon::kGrow;
    }
    return use_lm_ && start_.init != "given" &&
           (start_.init != "inverse_dynamics" || !AllAreComplete(fit_.captures()));
  }

  // Comes nearer to the answer by other ways than a fit to all frames.
  // @param resumed  where to continue; null: at the start
  void Approach(const Checkpoint* resumed) {
    if (options_.horizon == Horizon::kShooting) {
      Shoot();
    } else if (ShouldGrow()) {
      Grow(resumed);
    }
  }

  void Shoot() {
    if (start_.coordinates.size() == 0 || fit_.IsAtRounding()) return;
    const ShootingStart shot =
        ShootForStart(fit_.captures()[0], start_.coordinates, &context_);
    summary_.notes.insert(summary_.notes.end(), shot.notes.begin(), shot.notes.end());
    context_.first_iteration = context_.num_iterations;
    TakeBetter({shot.coordinates});
  }

  // @param resumed  where to continue; null: at the start
  void Grow(const Checkpoint* resumed) {
    if (start_.coordinates.size() == 0 || fit_.IsAtRounding()) return;
    const GrownHorizon grown =
        GrowHorizon(fit_.captures(), start_.coordinates, &context_, resumed);
    summary_.horizons = context_.horizons;
    summary_.notes.insert(summary_.notes.end(), grown.notes.begin(), grown.notes.end());
    summary_.evaluations += grown.num_rollouts;
    summary_.jacobian_evaluations += grown.num_derivative_passes;
    context_.first_iteration = context_.num_iterations;
    if (!grown.ok) return;
    std::vector<Eigen::VectorXd> points = {grown.coordinates};
    if (grown.before != start_.coordinates) points.push_back(grown.before);
    TakeBetter(points);
    // What was learnt of steps was learnt elsewhere.
    if (problem()->coordinates() != grown.coordinates) context_.initial_radius = 0.0;
  }

  // Goes on from the best of the start, if it can be simulated, and what has been made
  // of it, of which the first is looked at even if the fit was stopped.
  void TakeBetter(const std::vector<Eigen::VectorXd>& points) {
    for (size_t i = 0; i < points.size(); ++i) {
      if (i > 0 && stop_.stopped()) break;
      const StopControl::Grace grace(&stop_);
      const bool is_ok = evaluator()->Evaluate(points[i]);
      if (start_.ok) continue;
      start_.ok = is_ok;
      start_.message = evaluator()->message();
      if (is_ok) RecordStart();
    }
    if (!start_.ok) return;
    const Eigen::VectorXd best = evaluator()->best_coordinates();
    problem()->set_coordinates(best);
    evaluator()->Evaluate(best);
  }

  void PerturbStart() {
    if (options_.init_perturbation == 0.0 || start_.init == "given") return;
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
        NormaliseScale(captures_, problem()->layout(),
                       MassToKeep(captures_, options_.priors), &parameters);
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
    if (!fit_.IsAtRounding()) {
      Minimise();
      return;
    }
    if (context_.num_iterations == 0) {
      IterationReport report;
      report.cost = evaluator()->cost();
      context_.Report(report);
    }
    summary_.termination = Termination::kConverged;
    summary_.message =
        context_.num_iterations == 0
            ? "the starting point is the answer to the level of rounding "
              "(rms_tolerance)"
            : "the error has fallen to the level of rounding (rms_tolerance)";
  }

  void Minimise() {
    const OptimizerResult result = Minimize(use_lm_, &context_);
    summary_.termination = result.termination;
    summary_.message = result.message;
    // The optimiser does not tell of its last iteration.
    if (summary_.usable()) SaveCheckpoint("fit", context_, context_.last_radius);
  }

  // So that a local minimum or a plateau is not taken for the answer.
  void CheckForBetterBasins() {
    if (!HasFewParameters()) return;
    SearchBetterBasins({&fit_, &stop_, [this] { Minimise(); }, &summary_});
  }

  void Finish() {
    const bool has_result = evaluator()->best_coordinates().size() > 0;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    summary_.parameters = evaluator()->map().ToParameters(
        has_result ? evaluator()->best_coordinates() : problem()->coordinates());
    // Steps of the optimiser may have moved along the scale, which costs nothing.
    NormaliseScale(captures_, problem()->layout(),
                   MassToKeep(captures_, options_.priors), &summary_.parameters);
    summary_.final_cost = has_result ? evaluator()->best_cost() : nan;
    summary_.final_rms = has_result ? fit_.best_rms() : nan;
    summary_.prior_cost =
        has_result ? evaluator()->prior_rows().Cost(evaluator()->best_coordinates())
                   : nan;
    summary_.smoothness = options_.smoothness;
    summary_.iterations = context_.num_iterations;
    summary_.evaluations += evaluator()->num_rollouts();
    summary_.jacobian_evaluations += evaluator()->num_derivative_passes();
    SummariseCaptures(captures_, has_result, &fit_, &summary_);
    summary_.blocks = MakeEstimatedBlocks(problem()->layout(), summary_.parameters);
    if (!checkpoints_.problem().empty()) {
      summary_.notes.push_back(checkpoints_.problem());
    }
    FindUncertainty(has_result);
    if (!has_result || stop_.stopped() ||
        options_.uncertainty == UncertaintyMode::kOff) {
      summary_.sensitivity.message = "not asked for, or the fit was stopped";
    } else {
      FindSensitivity(options_, &stop_, &summary_);
    }
    summary_.wall_time_s = stop_.Seconds();
  }

  void FindUncertainty(bool has_result) {
    if (!has_result) {
      summary_.uncertainty.message = "there is no result";
    } else if (stop_.stopped()) {
      summary_.uncertainty.message = "the fit was stopped";
    } else if (!WantsUncertainty(options_, evaluator()->num_parameters(),
                                 fit_.noise_is_known())) {
      summary_.uncertainty.message = "not asked for";
    } else {
      summary_.uncertainty = UncertaintyOfFit(fit_.captures(), fit_.noise_is_known(),
                                              options_, evaluator());
    }
  }

  const std::vector<CaptureView> captures_;
  const EstimatorOptions options_;
  FitCheckpoints checkpoints_;
  StopControl stop_;
  FitProblem fit_;
  OptimizerContext context_;
  StartingPoint start_;
  EstimatorSummary summary_;
  bool use_lm_ = true;
};

EstimatorSummary EstimateCaptures(const std::vector<CaptureView>& captures,
                                  const EstimatorOptions& options) {
  const auto fit = [](const std::vector<CaptureView>& views,
                      const EstimatorOptions& fit_options) {
    return Fit(views, fit_options).Run();
  };
  return HasWeightsToChoose(options) ? FitWithChosenWeights(captures, options, fit)
                                     : fit(captures, options);
}

}  // namespace

EstimatorSummary Estimate(const Scene& scene, const Observations& observations,
                          const EstimatorOptions& options) {
  return EstimateCaptures({{&scene, &observations, "the capture"}}, options);
}

EstimatorSummary Estimate(const std::vector<CapturedMotion>& captures,
                          const EstimatorOptions& options) {
  std::vector<CaptureView> views;
  for (const CapturedMotion& capture : captures) {
    const std::string name = capture.name.empty()
                                 ? "capture " + std::to_string(views.size() + 1)
                                 : capture.name;
    views.push_back({&capture.scene, &capture.observations, name});
  }
  return EstimateCaptures(views, options);
}

}  // namespace dpe
