#include "horizon.h"

#include <algorithm>

#include "common_values.h"
#include "moved_observations.h"

namespace dpe {
namespace {

// Of the first horizon; one more than a frame's accelerations, so that stiffnesses are
// determined at all.
constexpr int kFirstHorizon = 6;

// A horizon is long if it has at least as many frames. A fit to a short one is only a
// start for the next and ends when an iteration lowers the cost by less than this
// fraction; one to a long one is carried through, because its answer, if it is exact,
// is that of all longer ones, which cost more per iteration.
constexpr int kLongHorizon = 48;
constexpr double kShortFunctionTolerance = 0.1;

class HorizonGrower {
 public:
  HorizonGrower(const std::vector<FitCapture>& captures, OptimizerContext* context)
      : captures_(captures),
        options_(*context->options),
        context_(context),
        num_frames_(MostObservedFrames()) {
    stage_context_ = *context;
    stage_context_.options = &options_;
  }

  GrownHorizon Run(const Eigen::VectorXd& start, const Checkpoint* resumed) {
    result_.coordinates = start;
    // Frame 0 is given, and horizons in which nothing was seen say nothing.
    int solved = FirstMovedFrame();
    int step = kFirstHorizon - 1;
    if (resumed != nullptr) {
      result_.coordinates = resumed->coordinates;
      result_.before = start;
      step = resumed->num_frames - solved;
      stage_context_.initial_radius = resumed->radius;
      stage_context_.horizons = resumed->horizons;
      if (!stage_context_.horizons.empty()) {
        unfinished_ = stage_context_.horizons.back();
        stage_context_.horizons.pop_back();
      }
    }
    needs_common_values_ = resumed == nullptr;
    while (solved + step < num_frames_ && !context_->is_over()) {
      if (Fit(solved + step)) {
        solved += step;
        result_.ok = true;
        step = solved;
      } else if (step > 1) {
        step /= 2;
      } else {
        break;
      }
    }
    context_->horizons = stage_context_.horizons;
    context_->initial_radius = stage_context_.last_radius;
    return result_;
  }

 private:
  int MostObservedFrames() const {
    int most = 0;
    for (const FitCapture& capture : captures_) {
      most = std::max(most, capture.observations.num_frames());
    }
    return most;
  }

  // Of the capture that shows something first.
  int FirstMovedFrame() const {
    int first = num_frames_;
    for (const FitCapture& capture : captures_) {
      first = std::min(first, dpe::FirstMovedFrame(capture.blank, capture.observations,
                                                   num_frames_));
    }
    return first;
  }

  // False if the start cannot be simulated over as many frames.
  bool Fit(int num_frames) {
    options_.function_tolerance = num_frames < kLongHorizon
                                      ? kShortFunctionTolerance
                                      : context_->options->function_tolerance;
    FitProblem fit(CutCaptures(captures_, num_frames), options_, context_->stop);
    TrajectoryEvaluator* evaluator = fit.evaluator();
    FindCommonValues(fit);
    if (result_.before.size() > 0 && result_.before != result_.coordinates) {
      evaluator->Evaluate(result_.before);
    }
    bool ok = evaluator->Evaluate(result_.coordinates);
    if (ok && evaluator->best_coordinates() != result_.coordinates) {
      ok = evaluator->Evaluate(result_.before);
      result_.coordinates = result_.before;
      stage_context_.initial_radius = 0.0;  // what was learnt of steps was elsewhere
    }
    if (ok) {
      result_.before = result_.coordinates;
      HorizonStage stage;
      stage.num_frames = num_frames;
      stage.start_rms = fit.best_rms();
      if (unfinished_.num_frames == num_frames) stage = unfinished_;
      unfinished_ = HorizonStage();
      stage_context_.horizons.push_back(stage);
      fit.problem()->set_coordinates(result_.coordinates);
      const int iterations_before = context_->num_iterations;
      if (!fit.IsAtRounding()) Minimise(&fit);
      stage.iterations += context_->num_iterations - iterations_before;
      stage.final_rms = fit.best_rms();
      stage_context_.horizons.back() = stage;
      result_.coordinates = evaluator->best_coordinates();
    } else {
      result_.message = evaluator->message();
    }
    result_.num_rollouts += evaluator->num_rollouts();
    result_.num_derivative_passes += evaluator->num_derivative_passes();
    return ok;
  }

  // Before the first horizon that can be simulated.
  void FindCommonValues(FitProblem& fit) {
    if (!needs_common_values_ ||
        !StartsWithCommonValues(*fit.evaluator(), result_.coordinates)) {
      return;
    }
    const CommonValues common = FitCommonValues(fit.captures(), *fit.evaluator(),
                                                result_.coordinates, context_);
    needs_common_values_ = !common.ok;
    if (common.ok) {
      result_.notes.push_back(
          "the elements start alike: one value for all of them was "
          "fitted first, to " +
          std::to_string(fit.num_frames()) + " frames");
    }
    result_.coordinates = common.coordinates;
    result_.num_rollouts += common.num_rollouts;
    result_.num_derivative_passes += common.num_derivative_passes;
  }

  void Minimise(FitProblem* fit) {
    stage_context_.fit = fit;
    stage_context_.num_iterations = context_->num_iterations;
    stage_context_.first_iteration = context_->num_iterations;
    Minimize(ChooseSolver(*fit->evaluator(), options_).is_lm, &stage_context_);
    // What was learnt of how far steps can be trusted holds for longer horizons too.
    stage_context_.initial_radius = stage_context_.last_radius;
    context_->num_iterations = stage_context_.num_iterations;
  }

  const std::vector<FitCapture>& captures_;
  EstimatorOptions options_;
  OptimizerContext* context_;
  OptimizerContext stage_context_;
  const int num_frames_;
  GrownHorizon result_;
  bool needs_common_values_ = true;
  HorizonStage unfinished_;  // in which a fit is continued
};

}  // namespace

GrownHorizon GrowHorizon(const std::vector<FitCapture>& captures,
                         const Eigen::VectorXd& start, OptimizerContext* context,
                         const Checkpoint* resumed) {
  return HorizonGrower(captures, context).Run(start, resumed);
}

}  // namespace dpe
