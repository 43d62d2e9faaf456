#include "fit_checkpoints.h"

#include <filesystem>
#include <limits>
#include <system_error>

#include "fingerprint.h"

namespace dpe {
namespace {

// A mistyped folder is noticed before the start of the fit is looked for.
void RequireFolder(const std::string& path) {
  const std::filesystem::path folder =
      std::filesystem::absolute(std::filesystem::path(path)).parent_path();
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored)) {
    throw SceneError(path + ": the checkpoint cannot be written: there is no folder " +
                     folder.string());
  }
}

}  // namespace

FitCheckpoints::FitCheckpoints(const std::vector<CaptureView>& captures,
                               const EstimatorOptions& options)
    : path_(options.checkpoint_path), resume_path_(options.resume_path) {
  if (path_.empty() && resume_path_.empty()) return;
  fingerprint_ = FingerprintOf(captures, options);
  if (!resume_path_.empty()) {
    resumed_ = ReadCheckpoint(resume_path_);
    RequireSameProblem(*resumed_, fingerprint_, resume_path_);
  }
  if (!path_.empty()) RequireFolder(path_);
}

void FitCheckpoints::RequireCoordinates(int num_parameters) const {
  if (resumed_->coordinates.size() == num_parameters &&
      resumed_->coordinates.allFinite() && resumed_->start.allFinite()) {
    return;
  }
  throw SceneError(resume_path_ + ": coordinates has " +
                   std::to_string(resumed_->coordinates.size()) +
                   " numbers; expected one finite number for each of the " +
                   std::to_string(num_parameters) + " parameters");
}

void FitCheckpoints::Save(const std::string& stage, const OptimizerContext& context,
                          double radius, const Eigen::VectorXd& start,
                          const EstimatorSummary& summary) {
  if (path_.empty()) return;
  const TrajectoryEvaluator& evaluator = *context.fit->evaluator();
  Checkpoint checkpoint;
  checkpoint.problem = fingerprint_;
  checkpoint.stage = stage;
  checkpoint.init = summary.init;
  checkpoint.notes = summary.notes;
  checkpoint.num_frames = context.fit->num_frames();
  checkpoint.horizons = context.horizons;
  if (stage == "grow") {
    checkpoint.horizons.back().iterations +=
        context.num_iterations - context.first_iteration;
  }
  checkpoint.iterations = context.num_iterations;
  checkpoint.first_iteration = context.first_iteration;
  checkpoint.radius = radius;
  checkpoint.seconds = context.stop->Seconds();
  checkpoint.initial_cost = summary.initial_cost;
  checkpoint.initial_rms = summary.initial_rms;
  checkpoint.start = start;
  const bool has_point = evaluator.best_coordinates().size() > 0;
  checkpoint.cost =
      has_point ? evaluator.best_cost() : std::numeric_limits<double>::quiet_NaN();
  checkpoint.coordinates = has_point ? evaluator.best_coordinates() : start;
  try {
    WriteCheckpoint(checkpoint, path_);
    problem_.clear();
  } catch (const SceneError& error) {
    problem_ = std::string("the last checkpoint was not written: ") + error.what();
  }
}

}  // namespace dpe
