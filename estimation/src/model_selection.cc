#include "dpe/estimation/model_selection.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "dpe/estimation/inverse_dynamics.h"
#include "fit_setup.h"
#include "forecast.h"
#include "forecast_weight.h"
#include "model_scenes.h"
#include "score_test.h"
#include "stop_control.h"

namespace dpe {
namespace {

// Enough to fit some and hold out some.
constexpr int kMinFrames = 6;

// Of what is left of max_seconds, for one candidate.
constexpr double kShareOfTime = 0.5;

// With one unknown per element, the first iterations find what the motion determines;
// later ones, which gain little, fit the noise with what it does not. Stopping between
// the two regularises (Hanke, A regularizing Levenberg-Marquardt scheme, 1997). Exact
// motions are not stopped by this: their cost falls by more until it is zero.
constexpr double kElementFunctionTolerance = 1e-2;

// A fit of so many parameters takes less time than to find out whether it is needed.
constexpr int kFewParameters = 50;

// Of values that no fit gave.
constexpr double kNoRms = -1.0;

std::string Text(double value) {
  std::ostringstream text;
  text.precision(3);
  text << value;
  return text.str();
}

bool HasResult(const EstimatorSummary& summary) {
  return std::isfinite(summary.final_cost);
}

void Check(const EstimatorOptions& options, int num_frames) {
  if (!options.checkpoint_path.empty() || !options.resume_path.empty()) {
    throw SceneError(
        "settings auto: a checkpoint holds one fit, not the choice between several; "
        "choose without one, then use it for a fit with the settings that were chosen");
  }
  if (num_frames < kMinFrames) {
    throw SceneError("settings auto: " + std::to_string(num_frames) +
                     " frames; accepted are " + std::to_string(kMinFrames) +
                     " or more, since some of them are held out");
  }
}

int NumFittedFrames(int num_frames, double held_out_fraction) {
  const int held_out = static_cast<int>(std::lround(num_frames * held_out_fraction));
  return num_frames - std::clamp(held_out, 1, num_frames - 3);
}

// Options for a model with these scenes: smoothness where there are elements that can
// be smooth; elements without it are regularised by stopping early.
void UseOnElements(const Scenes& scenes, EstimatorOptions* options) {
  auto& smoothness = options->smoothness;
  smoothness.erase(std::remove_if(smoothness.begin(), smoothness.end(),
                                  [&](const SmoothnessPrior& prior) {
                                    return !HasElements(scenes, prior.kind,
                                                        prior.object);
                                  }),
                   smoothness.end());
  if (smoothness.empty() && HasElements(scenes)) {
    options->function_tolerance =
        std::max(options->function_tolerance, kElementFunctionTolerance);
  }
}

struct FittedModel {
  Scenes scenes;  // with the fitted values, one per capture
  EstimatorSummary summary;
  Forecast forecast;
};

class ModelSelector {
 public:
  ModelSelector(const Captures& captures, const EstimatorOptions& options,
                const ModelSelectionOptions& selection)
      : options_(options),
        selection_(selection),
        stop_(options.max_seconds, options.interrupted),
        forecaster_(options) {
    for (const FitCapture& whole : PrepareAll(captures)) {
      Check(options, whole.num_frames);
      CapturedMotion capture = captures[whole_.size()];
      capture.observations = whole.observations;
      whole_.push_back(capture);
      const int fitted = NumFittedFrames(whole.num_frames, selection.held_out_fraction);
      capture.observations = CutFrames(whole.observations, 0, fitted);
      fitted_.push_back(std::move(capture));
      forecaster_.Add(whole_.back().scene, whole.observations, fitted,
                      whole.num_frames);
      num_frames_ = std::max(num_frames_, whole.num_frames);
      num_fitted_ = std::max(num_fitted_, fitted);
    }
    forecaster_.RequireHeldOut();
    result_.selection.num_frames = num_frames_;
    result_.selection.num_fitted_frames = num_fitted_;
    result_.selection.criterion =
        "forecast of the last " + std::to_string(num_frames_ - num_fitted_) +
        " frames" + (whole_.size() > 1 ? " (a third of each capture)" : "") +
        ": a richer model is kept if its weight in the best mixture of both forecasts "
        "is above 1/2 by two standard deviations";
  }

  SelectedModel Run() {
    FitFirst();
    if (!HasResult(best_.summary)) {
      result_.selection.reason = "not even the first candidate could be fitted";
      result_.summary = best_.summary;
    } else {
      for (const int object : selection_.objects) ChooseMode(object);
      FitChosen();
    }
    result_.selection.chosen = Settings(best_.scenes);
    result_.summary.wall_time_s = stop_.Seconds();
    return result_;
  }

 private:
  std::vector<ModelCandidate>& candidates() { return result_.selection.candidates; }

  std::vector<FitCapture> PrepareAll(const Captures& captures) const {
    std::vector<CaptureView> views;
    for (const CapturedMotion& capture : captures) {
      views.push_back({&capture.scene, &capture.observations,
                       capture.name.empty()
                           ? "capture " + std::to_string(views.size() + 1)
                           : capture.name});
    }
    return PrepareCaptures(views, options_.num_frames);
  }

  static std::string Settings(const Scenes& scenes) {
    return SettingsString(scenes[0]);
  }

  static ModelCandidate Row(const Scenes& scenes) {
    ModelCandidate row;
    row.settings = Settings(scenes);
    row.num_parameters = LayoutOf(scenes).size();
    return row;
  }

  void FitFirst() {
    Scenes scenes = ScenesOf(whole_);
    for (const int object : selection_.objects) {
      SetMode(object, ParameterMode::kGlobal, &scenes);
    }
    ModelCandidate row = Row(scenes);
    best_ = FitCandidate(scenes, nullptr, &row);
    row.kept = true;
    row.reason = "the simplest";
    candidates().push_back(row);
    ExplainChoice(row);
  }

  void ChooseMode(int object) {
    int num_parameters = LayoutOf(best_.scenes).size();
    for (const ParameterMode mode : {ParameterMode::kGroup, ParameterMode::kLocal}) {
      Scenes scenes = best_.scenes;
      SetMode(object, mode, &scenes);
      ModelCandidate row = Row(scenes);
      if (row.num_parameters <= num_parameters) {
        row.reason = mode == ParameterMode::kGroup
                         ? "not tried: there is one group of springs"
                         : "not tried: every spring is a group of its own";
      } else if (best_.forecast.is_exact) {
        row.reason =
            "not tried: " + Settings(best_.scenes) + " leaves nothing to explain";
      } else if (stop_.Poll()) {
        row.reason = "not tried: " + WhyStopped();
      } else {
        Try(scenes, &row);
      }
      num_parameters = std::max(num_parameters, row.num_parameters);
      candidates().push_back(row);
      if (row.kept) ExplainChoice(row);
    }
  }

  void Try(const Scenes& scenes, ModelCandidate* row) {
    row->compared_with = Settings(best_.scenes);
    if (IsFutile(scenes, *row)) {
      row->reason = "not tried: what " + row->compared_with +
                    " leaves unexplained has no more to do with these parameters than "
                    "noise has (score test)";
      return;
    }
    FittedModel model = FitCandidate(scenes, &best_, row);
    Judge(model, row);
    if (row->kept) best_ = std::move(model);
  }

  bool IsFutile(const Scenes& scenes, const ModelCandidate& row) {
    if (row.num_parameters <= kFewParameters) return false;
    return TestScore(In(scenes, fitted_), options_, &stop_).NothingToGain();
  }

  void Judge(const FittedModel& model, ModelCandidate* row) const {
    if (!HasResult(model.summary)) {
      row->reason = "not kept: the fit failed: " + model.summary.message;
    } else if (!model.forecast.ok && stop_.stopped()) {
      row->reason = "not judged: " + WhyStopped();
    } else if (!model.forecast.ok) {
      row->reason =
          "not kept: cannot be simulated over all frames: " + model.forecast.message;
    } else if (!best_.forecast.ok) {
      row->kept = true;
      row->reason = row->compared_with + " cannot be simulated over all frames";
    } else {
      const ForecastWeight weight =
          WeighForecasts(best_.forecast.residuals, model.forecast.residuals);
      row->weight = weight.weight;
      row->weight_deviation = weight.deviation;
      row->kept = weight.RicherIsBetter();
      const std::string than = " than " + row->compared_with;
      row->reason = row->kept             ? "a better forecast" + than
                    : weight.weight > 0.5 ? "not kept: not significantly better" + than
                                          : "not kept: no better a forecast" + than;
    }
    if (HasResult(model.summary) && !model.summary.usable()) {
      row->reason += " (the fit stopped early: " + model.summary.message + ")";
    }
  }

  std::string WhyStopped() const {
    return stop_.was_interrupted() ? "interrupted by the user"
                                   : "the time limit was reached";
  }

  void ExplainChoice(const ModelCandidate& row) {
    std::string& reason = result_.selection.reason;
    if (row.compared_with.empty()) {
      reason = row.settings +
               " is the simplest model, and no richer one's forecast is " +
               "significantly better";
      if (best_.forecast.is_exact) {
        reason = row.settings + " reproduces the held-out frames to RMS " +
                 Text(row.held_out_rms) + " m, which leaves nothing to explain";
      }
      return;
    }
    reason = row.settings + " forecasts the held-out frames to RMS " +
             Text(row.held_out_rms) + " m, significantly better than " +
             row.compared_with;
    const auto simpler = std::find_if(
        candidates().begin(), candidates().end(),
        [&](const ModelCandidate& c) { return c.settings == row.compared_with; });
    if (simpler != candidates().end() && std::isfinite(simpler->held_out_rms)) {
      reason += " (" + Text(simpler->held_out_rms) + " m)";
    }
  }

  FittedModel FitCandidate(const Scenes& scenes, const FittedModel* simpler,
                           ModelCandidate* row) {
    EstimatorOptions options = OptionsNow();
    options.max_seconds *= kShareOfTime;
    options.uncertainty = UncertaintyMode::kOff;
    UseOnElements(scenes, &options);
    Announce(*row, num_fitted_, false);
    const double before = stop_.Seconds();
    FittedModel model;
    model.summary =
        FitFrom(scenes, fitted_,
                simpler == nullptr ? kNoRms : simpler->summary.final_rms, options);
    model.scenes = HasResult(model.summary) ? FittedScenes(model.summary) : scenes;
    row->was_fitted = true;
    row->termination = model.summary.termination;
    row->iterations = model.summary.iterations;
    row->fit_rms = model.summary.final_rms;
    if (HasResult(model.summary)) {
      model.forecast = forecaster_.Run(model.scenes, options_.num_threads, &stop_);
      if (model.forecast.ok) row->held_out_rms = model.forecast.rms;
    }
    row->seconds = stop_.Seconds() - before;
    return model;
  }

  // Fits `captures` from the values in `scenes`, which have this RMS (m, or kNoRms), or
  // from where the options say, if that is closer to the target.
  static EstimatorSummary FitFrom(const Scenes& scenes, const Captures& captures,
                                  double rms, const EstimatorOptions& options) {
    const Captures own = WithModesOf(scenes, captures);
    if (rms == kNoRms) return Estimate(own, options);
    const bool has_own_start =
        options.init != InitMethod::kAuto ||
        std::any_of(own.begin(), own.end(), [](const CapturedMotion& capture) {
          return InverseDynamicsApplies(capture.scene, capture.observations);
        });
    if (has_own_start) {
      EstimatorOptions look = options;
      look.max_iterations = 0;
      look.horizon = Horizon::kFull;
      look.uncertainty = UncertaintyMode::kOff;
      look.max_checked_parameters = 0;
      look.progress = nullptr;
      if (Estimate(own, look).initial_rms < rms) return Estimate(own, options);
    }
    EstimatorOptions warm = options;
    warm.init = InitMethod::kScene;
    // The start has seen more than a short horizon shows; with one unknown per element
    // a short horizon would be fitted to its noise, from which longer ones do not
    // recover.
    if (warm.horizon == Horizon::kAuto) warm.horizon = Horizon::kFull;
    warm.init_perturbation = 0.0;
    return Estimate(In(scenes, captures), warm);
  }

  void FitChosen() {
    if (stop_.Poll()) {
      result_.summary = best_.summary;
      result_.summary.termination = stop_.was_interrupted() ? Termination::kInterrupted
                                                            : Termination::kMaxSeconds;
      result_.summary.message =
          WhyStopped() + " before the chosen model was fitted to all frames";
      result_.summary.notes.push_back("the values are of a fit to the first " +
                                      std::to_string(num_fitted_) +
                                      " frames; the others were held out");
      return;
    }
    EstimatorOptions options = OptionsNow();
    const double tolerance = options.function_tolerance;
    UseOnElements(best_.scenes, &options);
    if (best_.forecast.is_exact) options.function_tolerance = tolerance;
    const bool stops_early = options.function_tolerance > tolerance;
    Announce(Row(best_.scenes), num_frames_, true);
    result_.summary =
        FitFrom(best_.scenes, whole_,
                best_.forecast.ok ? best_.forecast.rms_of_all_frames : kNoRms, options);
    if (stops_early && result_.summary.usable()) {
      result_.summary.notes.push_back(
          "the fit was ended, as the candidate's was, where an iteration lowered the "
          "cost by less than 1 %: with one unknown per element more would fit the "
          "noise; a fit with these settings alone goes on");
    }
  }

  void Announce(const ModelCandidate& row, int num_frames, bool is_final) const {
    if (!selection_.started) return;
    selection_.started({row.settings, row.num_parameters, num_frames, is_final});
  }

  // With what is left of the time, and reports in the time of the whole.
  EstimatorOptions OptionsNow() const {
    EstimatorOptions options = options_;
    options.num_frames = 0;  // captures are cut
    const double before = stop_.Seconds();
    options.max_seconds = std::max(0.0, options.max_seconds - before);
    if (options_.progress) {
      options.progress = [this, before](IterationReport report) {
        report.seconds += before;
        options_.progress(report);
      };
    }
    return options;
  }

  const EstimatorOptions& options_;
  const ModelSelectionOptions& selection_;
  StopControl stop_;
  Captures whole_, fitted_;  // all frames, and those that candidates are fitted to
  int num_frames_ = 0;       // of the longest
  int num_fitted_ = 0;
  Forecaster forecaster_;
  FittedModel best_;
  SelectedModel result_;
};

}  // namespace

SelectedModel SelectModel(const std::vector<CapturedMotion>& captures,
                          const EstimatorOptions& options,
                          const ModelSelectionOptions& selection) {
  return ModelSelector(captures, options, selection).Run();
}

SelectedModel SelectModel(const Scene& scene, const Observations& observations,
                          const EstimatorOptions& options,
                          const ModelSelectionOptions& selection) {
  return SelectModel({{scene, observations, "the capture"}}, options, selection);
}

}  // namespace dpe
