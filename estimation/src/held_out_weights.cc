#include "held_out_weights.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>
#include <vector>

#include "dpe/estimation/checkpoint.h"
#include "dpe/estimation/trajectory_evaluator.h"
#include "fit_problem.h"
#include "frame_interpolation.h"

namespace dpe {
namespace {

constexpr double kHeldOut = 0.2;  // of the frames
constexpr int kLeastFrames = 5;

// Powers of ten: neighbours that differ by a thousandth, up to a factor of e^10.
constexpr int kStrongest = 6;
constexpr int kWeakest = -2;
// Candidates in a row that are worse than the best end the path.
constexpr int kWorseInARow = 2;

// Of a candidate: far below what tells two weights apart.
constexpr double kFunctionTolerance = 1e-6;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<SmoothnessPrior> WithWeight(std::vector<SmoothnessPrior> smoothness,
                                        double weight) {
  for (SmoothnessPrior& one : smoothness) {
    if (one.is_chosen) one.weight = weight;
  }
  return smoothness;
}

// What was observed in frames first ... num_frames - 1, at the same times.
Observations FromFrame(int first, int num_frames, Observations observations) {
  for (Eigen::MatrixXd& positions : observations.positions) {
    positions.leftCols(std::min<Eigen::Index>(first, positions.cols()))
        .setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  std::vector<MarkerSample> late;
  for (const MarkerSample& sample : observations.samples) {
    if (!IsWithinFrames(sample.time, first) &&
        IsWithinFrames(sample.time, num_frames)) {
      late.push_back(sample);
    }
  }
  observations.samples = std::move(late);
  return observations;
}

class WeightSearch {
 public:
  WeightSearch(const std::vector<CaptureView>& captures,
               const EstimatorOptions& options, const FitFunction& fit)
      : captures_(captures),
        options_(options),
        fit_(fit),
        whole_(PrepareCaptures(captures, options.num_frames)) {
    training_.reserve(whole_.size());
    for (size_t c = 0; c < whole_.size(); ++c) {
      const int num_frames = whole_[c].num_frames;
      if (num_frames < kLeastFrames) {
        throw SceneError(captures[c].name +
                         ": smoothness with a weight chosen by held-out frames (auto) "
                         "needs " +
                         std::to_string(kLeastFrames) + " frames, there are " +
                         std::to_string(num_frames));
      }
      const int held_out =
          std::max(1, static_cast<int>(std::lround(kHeldOut * num_frames)));
      num_training_.push_back(num_frames - held_out);
      training_.push_back(CutFrames(whole_[c].observations, 0, num_training_.back()));
    }
    MakeHeldOut();
  }

  EstimatorSummary Run() {
    int worse = 0;
    for (int power = kStrongest; power >= kWeakest && worse < kWorseInARow; --power) {
      const bool is_best = Try(std::pow(10.0, power));
      worse = is_best || !has_best_ ? 0 : worse + 1;
      if (is_over_) break;
    }
    if (has_best_) candidates_[best_index_].is_chosen = true;
    if (was_interrupted_ || !has_best_) return Unfinished();
    return FitAllFrames();
  }

 private:
  void MakeHeldOut() {
    bool is_anything_observed = false;
    std::vector<TrajectorySegment> segments(whole_.size());
    for (size_t c = 0; c < whole_.size(); ++c) {
      const FitCapture& capture = whole_[c];
      segments[c].scene = capture.blank;
      segments[c].costs = MakePositionCosts(
          capture.blank,
          FromFrame(num_training_[c], capture.num_frames, capture.observations),
          capture.num_frames, CostOptionsOf(options_));
      is_anything_observed |= !segments[c].costs.empty();
    }
    if (!is_anything_observed) {
      throw SceneError("smoothness: no free vertex is observed in the frames from " +
                       std::to_string(num_training_[0]) +
                       " on, by which a weight (auto) would be chosen; give a number");
    }
    TrajectoryEvaluatorOptions evaluator_options;
    evaluator_options.own_wind = true;  // as in the fit
    evaluator_options.num_threads = options_.num_threads;
    evaluator_options.memory_limit_bytes = options_.memory_limit_bytes;
    evaluator_options.interrupted = options_.interrupted;
    held_out_evaluator_ = std::make_unique<TrajectoryEvaluator>(
        std::move(segments), std::vector<SegmentLink>(), evaluator_options);
  }

  // The captures with what a candidate may see of them.
  std::vector<CaptureView> Training() const {
    std::vector<CaptureView> views = captures_;
    for (size_t c = 0; c < views.size(); ++c) views[c].observations = &training_[c];
    return views;
  }

  double Seconds() const {
    return std::chrono::duration<double>(Clock::now() - begin_).count();
  }

  // Iterations and time go on from one fit to the next.
  EstimatorOptions Base(double max_seconds) const {
    EstimatorOptions options = options_;
    options.max_seconds = std::max(0.0, max_seconds - Seconds());
    if (options_.progress) {
      options.progress = [this, before = iterations_,
                          seconds = Seconds()](IterationReport report) {
        report.iteration += before;
        report.seconds += seconds;
        options_.progress(report);
      };
    }
    return options;
  }

  // True if the weight is the best so far.
  bool Try(double weight) {
    EstimatorOptions options = Base(0.5 * options_.max_seconds);
    options.smoothness = WithWeight(options_.smoothness, weight);
    options.num_frames = 0;  // all that there are
    options.uncertainty = UncertaintyMode::kOff;
    options.checkpoint_path.clear();
    options.resume_path.clear();
    options.function_tolerance =
        std::max(options.function_tolerance, kFunctionTolerance);
    if (has_start_) {
      options.start = last_.parameters;
      options.horizon = Horizon::kFull;
    }
    EstimatorSummary fitted = fit_(Training(), options);
    Count(fitted);
    was_interrupted_ = fitted.termination == Termination::kInterrupted;
    is_over_ = was_interrupted_ || fitted.termination == Termination::kMaxSeconds;
    SmoothnessCandidate candidate;
    candidate.weight = weight;
    candidate.iterations = fitted.iterations;
    candidate.training_cost = fitted.final_cost - fitted.prior_cost;
    const bool has_result = std::isfinite(fitted.final_cost);
    if (!has_result) candidate.message = fitted.message;
    if (has_result && !has_start_) first_init_ = fitted.init;
    Predict(fitted, &candidate);
    // A fit that was cut short says little of its weight, unless there is no other.
    const bool is_best =
        has_result &&
        (!has_best_ || (!is_over_ && candidate.held_out_cost < best_held_out_cost_));
    candidates_.push_back(candidate);
    if (is_best) {
      has_best_ = true;
      best_index_ = candidates_.size() - 1;
      best_held_out_cost_ = candidate.held_out_cost;
      best_ = fitted;
    }
    if (has_result) has_start_ = true;
    if (has_result || !has_start_) last_ = std::move(fitted);
    return is_best;
  }

  void Predict(const EstimatorSummary& fitted, SmoothnessCandidate* candidate) {
    candidate->held_out_cost = candidate->held_out_rms = kInfinity;
    if (!candidate->message.empty()) return;
    TrajectoryEvaluator& evaluator = *held_out_evaluator_;
    if (!evaluator.Evaluate(evaluator.map().ToCoordinates(fitted.parameters))) {
      candidate->message = evaluator.message();
      return;
    }
    candidate->held_out_cost = evaluator.data_cost();
    PositionErrors errors;
    for (size_t c = 0; c < whole_.size(); ++c) {
      AddPositionErrors(evaluator.trajectory(static_cast<int>(c)),
                        whole_[c].observations, whole_[c].num_frames, &errors,
                        num_training_[c]);
    }
    candidate->held_out_rms = errors.Rms();
  }

  void Count(const EstimatorSummary& fitted) {
    iterations_ += fitted.iterations;
    evaluations_ += fitted.evaluations;
    jacobian_evaluations_ += fitted.jacobian_evaluations;
  }

  EstimatorSummary FitAllFrames() {
    EstimatorOptions options = Base(options_.max_seconds);
    const double weight = candidates_[best_index_].weight;
    options.smoothness = WithWeight(options_.smoothness, weight);
    // As asked for in all else, so that a checkpoint is one of this fit.
    options.start = best_.parameters;
    EstimatorSummary summary = fit_(captures_, options);
    summary.init = first_init_;
    std::ostringstream note;
    note << "smoothness: of " << candidates_.size() << " weights, " << weight
         << " predicts the last " << whole_[0].num_frames - num_training_[0]
         << " frames best from the first " << num_training_[0];
    if (whole_.size() > 1) note << " (of the first capture, likewise of the others)";
    if (best_index_ == 0 || weight < 1.5 * std::pow(10.0, kWeakest)) {
      note << "; it is at the end of the range that was tried";
    }
    if (is_over_) note << "; there was no time to try weaker ones";
    summary.notes.push_back(note.str());
    return WithTable(std::move(summary));
  }

  // The best candidate, or what kept all of them from having a result.
  EstimatorSummary Unfinished() {
    EstimatorSummary summary = has_best_ ? best_ : last_;
    if (was_interrupted_) {
      summary.termination = Termination::kInterrupted;
      summary.message = "interrupted by the user";
    }
    if (has_best_) {
      summary.notes.push_back(
          "smoothness: stopped while weights were tried; this is the fit to the "
          "first " +
          std::to_string(num_training_[0]) + " frames with the best of them");
    }
    summary.iterations = summary.evaluations = summary.jacobian_evaluations = 0;
    return WithTable(std::move(summary));
  }

  EstimatorSummary WithTable(EstimatorSummary summary) {
    summary.smoothness_candidates = candidates_;
    summary.iterations += iterations_;
    summary.evaluations += evaluations_;
    summary.jacobian_evaluations += jacobian_evaluations_;
    summary.wall_time_s = Seconds();
    return summary;
  }

  using Clock = std::chrono::steady_clock;

  const std::vector<CaptureView>& captures_;
  const EstimatorOptions& options_;
  const FitFunction& fit_;
  const std::vector<FitCapture> whole_;
  std::vector<int> num_training_;  // frames of each capture
  std::vector<Observations> training_;
  const Clock::time_point begin_ = Clock::now();
  std::unique_ptr<TrajectoryEvaluator> held_out_evaluator_;
  std::vector<SmoothnessCandidate> candidates_;
  EstimatorSummary best_, last_;
  std::string first_init_;
  bool has_best_ = false, has_start_ = false;
  bool is_over_ = false, was_interrupted_ = false;
  size_t best_index_ = 0;
  double best_held_out_cost_ = kInfinity;
  int iterations_ = 0, evaluations_ = 0, jacobian_evaluations_ = 0;
};

// The weights with which the fit of a checkpoint went on.
std::vector<SmoothnessPrior> WeightsOf(const Checkpoint& checkpoint,
                                       const std::string& path) {
  for (const auto& [key, value] : checkpoint.problem) {
    if (key == "smoothness") return SmoothnessFromText(value);
  }
  throw SceneError(path + ": is the checkpoint of a fit without smoothness");
}

}  // namespace

bool HasWeightsToChoose(const EstimatorOptions& options) {
  return std::any_of(
      options.smoothness.begin(), options.smoothness.end(),
      [](const SmoothnessPrior& one) { return one.is_chosen && !(one.weight > 0.0); });
}

EstimatorSummary FitWithChosenWeights(const std::vector<CaptureView>& captures,
                                      const EstimatorOptions& options,
                                      const FitFunction& fit) {
  if (options.resume_path.empty()) {
    return WeightSearch(captures, options, fit).Run();
  }
  EstimatorOptions resumed = options;
  const std::vector<SmoothnessPrior> known =
      WeightsOf(ReadCheckpoint(options.resume_path), options.resume_path);
  for (SmoothnessPrior& one : resumed.smoothness) {
    for (const SmoothnessPrior& other : known) {
      if (one.is_chosen && other.is_chosen && other.kind == one.kind &&
          other.object == one.object) {
        one.weight = other.weight;
      }
    }
  }
  if (HasWeightsToChoose(resumed)) {
    throw SceneError(options.resume_path +
                     ": is the checkpoint of a fit with another smoothness (" +
                     SmoothnessText(known) + " there, " +
                     SmoothnessText(options.smoothness) + " now)");
  }
  return fit(captures, resumed);
}

}  // namespace dpe
