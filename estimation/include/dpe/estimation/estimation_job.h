// One estimation from files to files: what estimate_cloth does, without its flags.
// Scenes and targets may also be given in memory.
#ifndef DPE_ESTIMATION_ESTIMATION_JOB_H_
#define DPE_ESTIMATION_ESTIMATION_JOB_H_

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dpe/engine/quality.h"
#include "dpe/engine/scene.h"
#include "dpe/engine/trajectory.h"
#include "dpe/estimation/estimator.h"
#include "dpe/estimation/export.h"
#include "dpe/estimation/load_target.h"
#include "dpe/estimation/model_selection.h"
#include "dpe/estimation/observations.h"
#include "dpe/estimation/scene_from_target.h"
#include "dpe/estimation/trajectory_io.h"

namespace dpe {

struct EstimationJob {
  // One per capture, or one for all targets; empty: each target's is made of it.
  std::vector<std::string> scene_paths;
  std::vector<Scene> scenes;  // in memory, in place of scene_paths
  SceneFromTargetOptions scene_from_target;
  // What to estimate, as ApplyAutoSettings reads it; empty: as the scene says.
  std::string settings;
  // Whose time stepping (QualityPreset::estimation) takes the place of the scenes': of
  // the fit and, where there are no targets, of the motions that are made to be them.
  // Not in place of what scene_from_target says, where it is to be kept.
  std::optional<Quality> quality;
  bool keep_integrator = false;
  bool keep_steps_per_frame = false;
  // More to estimate: "damping", "drag", "wind", "initial_velocity", of all objects
  // that have it.
  std::vector<std::string> estimate;
  // What to fit, one per capture, in any format that ReadCapture reads; empty: the
  // motions that the scenes' own parameters make, which then serve to report the
  // deviation and for nothing else.
  std::vector<std::string> target_paths;
  // In memory, in place of target_paths. Of `target` what is about files is not used,
  // and neither are marker maps, attachment and rest shapes.
  std::vector<Observations> targets;
  TargetOptions target;
  TrajectoryFormat trajectory_format = TrajectoryFormat::kCsv;  // of the result
  // To fit, of each capture as many as it has; <= 0: as its scene says, at most the
  // file's.
  int num_frames = 0;
  int num_validation_frames = 0;  // to compare after the fit; 0: none
  double noise_sigma = 0.0;       // m, added to the target, see AddNoise
  std::uint64_t noise_seed = 0;   // of the first capture; the others' follow from it
  // m, of the noise on each coordinate where the target names none; 0: noise_sigma
  double sigma = 0.0;
  std::string output_dir;  // empty: results/<scene>_<settings>
  EstimatorOptions options;
};

// One capture as a job reads it.
struct CaptureInput {
  std::string scene_path;   // empty: made of the target
  std::string target_path;  // empty: the scene's own motion
  Scene scene;              // with the settings applied
  Observations target;      // the frames to fit, with noise
  Observations reference;   // all known frames, without added noise
  int num_frames = 0;
  int num_validation_frames = 0;  // at most what the reference holds
};

// What a job reads.
struct EstimationInput {
  std::vector<CaptureInput> captures;
  std::vector<std::string> warnings;
  std::vector<int> auto_objects;  // whose settings are to be chosen
  bool truth_is_known = false;    // the scenes' values made the targets

  DPE_ESTIMATION_API std::vector<const Scene*> scenes() const;
};

struct Validation {
  int num_frames = 0;  // 0: there was none
  double rms = 0.0;    // m; NaN if the rollout failed
  // m, of the frames that were not fitted alone; NaN without any, or if the rollout
  // failed
  double held_out_rms = 0.0;
  PositionErrors errors, held_out_errors;  // what they are of
  Trajectory trajectory;  // of the fitted scene, as many frames as fitted or validated
  std::string note;       // why there is no RMS
};

// Reads scenes and targets; makes targets and their noise.
// @throws SceneError for bad input, as many targets as there are not scenes for, scenes
//         that are not of the same cloths, and if a scene's own motion cannot be
//         simulated
DPE_ESTIMATION_API EstimationInput LoadEstimationInput(const EstimationJob& job);

// Estimate with what was read; where settings are to be chosen (input->auto_objects),
// SelectModel, after which the scenes have the chosen ones.
// @param options    of the fit
// @param started    told of each model that is about to be fitted, if set
// @param input      what LoadEstimationInput returned
// @param selection  receives how the settings were chosen; not touched where they are
//                   not to be
DPE_ESTIMATION_API EstimatorSummary
RunEstimation(const EstimatorOptions& options,
              const std::function<void(const ModelFit&)>& started,
              EstimationInput* input, ModelSelection* selection);

// The job's output folder, created if it is missing. Where the settings are to be
// chosen, its name says so: results/<scene>_auto.
// @throws SceneError if it cannot be
DPE_ESTIMATION_API std::string PrepareOutputDir(const EstimationJob& job,
                                                const EstimationInput& input);

// Simulates the fitted scenes beyond the fit and compares with the references; one per
// capture.
DPE_ESTIMATION_API std::vector<Validation> Validate(const EstimatorSummary& summary,
                                                    const EstimationInput& input,
                                                    int num_threads);

// All of them as one: the frames of the longest, the RMS over all (NaN if one is
// missing), without trajectory.
DPE_ESTIMATION_API Validation Together(const std::vector<Validation>& validations);

// Writes <scene>_<settings>_optimized.txt, trajectory.csv (or .pc2, .npy, or
// trajectory_*.obj, see trajectory_format) and report.json, each atomically; only the
// report if no point could be simulated. Of several captures scene_1.txt,
// trajectory_1.csv (or trajectory_1_*.obj), scene_2.txt, ...
// @param job          what was asked for
// @param input        what was read
// @param summary      what RunEstimation returned
// @param validations  what Validate returned
// @param output_dir   what PrepareOutputDir returned
// @param selection    how the settings were chosen; null: they were not
// @return             the paths written
DPE_ESTIMATION_API std::vector<std::string> WriteResults(
    const EstimationJob& job, const EstimationInput& input,
    const EstimatorSummary& summary, const std::vector<Validation>& validations,
    const std::string& output_dir, const ModelSelection* selection = nullptr);

// "<scene>_<settings>", the scene being its file name without extension, or that of the
// target it was made of, with "_and_2_more" after it where there are others.
DPE_ESTIMATION_API std::string JobName(const EstimationJob& job,
                                       const EstimationInput& input);

}  // namespace dpe

#endif  // DPE_ESTIMATION_ESTIMATION_JOB_H_
