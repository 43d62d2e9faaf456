// One estimation from files to files: what estimate_cloth does, without its flags.
#ifndef DPE_ESTIMATION_ESTIMATION_JOB_H_
#define DPE_ESTIMATION_ESTIMATION_JOB_H_

#include <cstdint>
#include <string>
#include <vector>

#include "dpe/engine/scene.h"
#include "dpe/engine/trajectory.h"
#include "dpe/estimation/estimator.h"
#include "dpe/estimation/load_target.h"
#include "dpe/estimation/observations.h"
#include "dpe/estimation/scene_from_target.h"
#include "dpe/estimation/trajectory_io.h"

namespace dpe {

struct EstimationJob {
  std::string scene_path;  // empty: the scene is made of the target
  SceneFromTargetOptions scene_from_target;
  // What to estimate, as ApplySettings reads it; empty: as the scene says.
  std::string settings;
  // More to estimate: "damping", "drag", "wind", "initial_velocity", of all objects
  // that have it.
  std::vector<std::string> estimate;
  // What to fit, in any format that ReadCapture reads; empty: the motion that the
  // scene's own parameters make, which then serve to report the deviation and for
  // nothing else.
  std::string target_path;
  TargetOptions target;
  TrajectoryFormat trajectory_format = TrajectoryFormat::kCsv;  // of the result
  int num_frames = 0;             // to fit; <= 0: as the scene says, at most the file's
  int num_validation_frames = 0;  // to compare after the fit; 0: none
  double noise_sigma = 0.0;       // m, added to the target, see AddNoise
  std::uint64_t noise_seed = 0;
  // m, of the noise on each coordinate where the target names none; 0: noise_sigma
  double sigma = 0.0;
  std::string output_dir;  // empty: results/<scene>_<settings>
  EstimatorOptions options;
};

// What a job reads.
struct EstimationInput {
  Scene scene;  // with the settings applied
  std::vector<std::string> warnings;
  Observations target;          // the frames to fit, with noise
  Observations reference;       // all known frames, without added noise
  bool truth_is_known = false;  // the scene's values made the target
  int num_frames = 0;
  int num_validation_frames = 0;  // at most what the reference holds
};

struct Validation {
  int num_frames = 0;  // 0: there was none
  double rms = 0.0;    // m; NaN if the rollout failed
  // m, of the frames that were not fitted alone; NaN without any, or if the rollout
  // failed
  double held_out_rms = 0.0;
  Trajectory trajectory;  // of the fitted scene, as many frames as fitted or validated
  std::string note;       // why there is no RMS
};

// Reads scene and target; makes the target and its noise.
// @throws SceneError for bad input, and if the scene's own motion cannot be simulated
EstimationInput LoadEstimationInput(const EstimationJob& job);

// The job's output folder, created if it is missing.
// @throws SceneError if it cannot be
std::string PrepareOutputDir(const EstimationJob& job, const Scene& scene);

// Simulates the fitted scene beyond the fit and compares with the reference.
Validation Validate(const EstimatorSummary& summary, const EstimationInput& input,
                    int num_threads);

// Writes <scene>_<settings>_optimized.txt, trajectory.csv (or .pc2, .npy, or
// trajectory_*.obj, see trajectory_format) and report.json, each
// atomically; only the report if no point could be simulated.
// @return the paths written
std::vector<std::string> WriteResults(const EstimationJob& job,
                                      const EstimationInput& input,
                                      const EstimatorSummary& summary,
                                      const Validation& validation,
                                      const std::string& output_dir);

// "<scene>_<settings>", the scene being its file name without extension, or that of the
// target it was made of.
std::string JobName(const EstimationJob& job, const Scene& scene);

}  // namespace dpe

#endif  // DPE_ESTIMATION_ESTIMATION_JOB_H_
