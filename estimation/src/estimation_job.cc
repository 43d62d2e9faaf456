#include "dpe/estimation/estimation_job.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <system_error>

#include "dpe/engine/parameters.h"
#include "dpe/engine/scene_io.h"
#include "dpe/engine/simulator.h"
#include "dpe/estimation/report_io.h"
#include "dpe/estimation/trajectory_io.h"
#include "fit_setup.h"

namespace dpe {
namespace {

SimulatorOptions OptionsFor(const EstimatorOptions& options) {
  SimulatorOptions simulator_options;
  simulator_options.only_estimated_objects = true;
  simulator_options.num_threads = options.num_threads;
  simulator_options.interrupted = options.interrupted;
  return simulator_options;
}

void LoadTarget(const EstimationJob& job, EstimationInput* input) {
  input->reference =
      LoadTarget(job.target_path, job.target, &input->scene, &input->warnings);
  const int in_file = input->reference.num_frames();
  if (job.num_frames > in_file) {
    throw SceneError("--frames: " + std::to_string(job.num_frames) +
                     " asked for; accepted are 2 to " + std::to_string(in_file) +
                     ", the frames in " + job.target_path);
  }
  input->num_frames =
      job.num_frames > 0 ? job.num_frames : std::min(input->scene.num_frames, in_file);
  input->num_validation_frames = std::min(job.num_validation_frames, in_file);
}

void MakeTarget(const EstimationJob& job, EstimationInput* input) {
  input->truth_is_known = true;
  input->num_frames = job.num_frames > 0 ? job.num_frames : input->scene.num_frames;
  input->num_validation_frames = job.num_validation_frames;
  Simulator simulator(input->scene, OptionsFor(job.options));
  const Trajectory truth =
      simulator.Simulate(std::max(input->num_frames, input->num_validation_frames));
  if (!truth.status.ok() && truth.status.frame < input->num_frames) {
    throw SceneError(job.scene_path +
                     ": the scene's own motion, which is to be the target, cannot be "
                     "simulated: " +
                     truth.status.Message());
  }
  input->reference = ObserveAll(truth);
}

std::string TrajectoryPath(const EstimationJob& job, const std::string& output_dir) {
  switch (job.trajectory_format) {
    case TrajectoryFormat::kObj:
      return output_dir + "/trajectory_*.obj";
    case TrajectoryFormat::kPc2:
      return output_dir + "/trajectory.pc2";
    case TrajectoryFormat::kNpy:
      return output_dir + "/trajectory.npy";
    case TrajectoryFormat::kAuto:
    case TrajectoryFormat::kCsv:
      break;
  }
  return output_dir + "/trajectory.csv";
}

// Marks a quantity as estimated: of the objects of which something is estimated
// already, of all if there are none.
void EstimateMore(const std::string& what, Scene* scene) {
  const auto has_settings = [](const ClothObject& cloth) {
    return cloth.mass_mode != ParameterMode::kFixed ||
           cloth.stiffness_mode != ParameterMode::kFixed;
  };
  const bool all =
      std::none_of(scene->objects.begin(), scene->objects.end(), has_settings);
  for (ClothObject& cloth : scene->objects) {
    if (!all && !has_settings(cloth)) continue;
    if (what == "damping") {
      cloth.estimate_damping = true;
    } else if (what == "drag") {
      cloth.estimate_drag = true;
    } else if (what == "initial_velocity") {
      cloth.estimate_initial_velocity = true;
    } else if (what == "wind") {
      scene->estimate_wind = true;
    } else {
      throw SceneError("--estimate: \"" + what +
                       "\" is not accepted; expected damping, drag, wind or "
                       "initial_velocity, separated by commas");
    }
  }
}

// The file that the scene comes from.
const std::string& SceneName(const EstimationJob& job) {
  return job.scene_path.empty() ? job.target_path : job.scene_path;
}

bool HasResult(const EstimatorSummary& summary) {
  return std::isfinite(summary.final_cost);
}

}  // namespace

std::string JobName(const EstimationJob& job, const Scene& scene) {
  return std::filesystem::path(SceneName(job)).stem().string() + "_" +
         SettingsString(scene);
}

EstimationInput LoadEstimationInput(const EstimationJob& job) {
  EstimationInput input;
  input.scene = job.scene_path.empty() ? SceneFromTarget(job.target_path, job.target,
                                                         job.scene_from_target)
                                       : LoadScene(job.scene_path, &input.warnings);
  if (!job.settings.empty()) ApplySettings(job.settings, &input.scene);
  for (const std::string& what : job.estimate) EstimateMore(what, &input.scene);
  if (ParameterLayout(input.scene).size() == 0) {
    throw SceneError(
        SceneName(job) + ": nothing is estimated (settings \"" +
        SettingsString(input.scene) +
        "\"); accepted in --settings are two letters per object, mass then "
        "stiffness, each n, G, L or R and not all n");
  }
  if (job.target_path.empty()) {
    MakeTarget(job, &input);
  } else {
    LoadTarget(job, &input);
  }
  if (input.num_frames < 2) {
    throw SceneError("--frames: " + std::to_string(input.num_frames) +
                     "; accepted are 2 or more (frame 0 is the initial state)");
  }
  input.target = CutFrames(input.reference, 0, input.num_frames);
  input.target.sigma = job.sigma > 0.0 ? job.sigma : job.noise_sigma;
  if (job.noise_sigma > 0.0) {
    AddNoise(input.scene, job.noise_sigma, job.noise_seed, &input.target);
  }
  return input;
}

std::string PrepareOutputDir(const EstimationJob& job, const Scene& scene) {
  const std::string dir =
      job.output_dir.empty() ? "results/" + JobName(job, scene) : job.output_dir;
  std::error_code error;
  std::filesystem::create_directories(dir, error);
  if (error || !std::filesystem::is_directory(dir, error)) {
    throw SceneError("--output_dir: " + dir + " cannot be created" +
                     (error ? ": " + error.message() : ": it is not a folder"));
  }
  return dir;
}

Validation Validate(const EstimatorSummary& summary, const EstimationInput& input,
                    int num_threads) {
  Validation validation;
  validation.rms = validation.held_out_rms = std::numeric_limits<double>::quiet_NaN();
  if (!HasResult(summary)) return validation;
  validation.num_frames = input.num_validation_frames;
  SimulatorOptions options;
  options.only_estimated_objects = true;
  options.num_threads = num_threads;
  Simulator simulator(summary.scene, options);
  validation.trajectory =
      simulator.Simulate(std::max(summary.num_frames, validation.num_frames));
  const RolloutStatus& status = validation.trajectory.status;
  if (!status.ok() && status.frame < validation.num_frames) {
    validation.note = "validation failed: " + status.Message();
  } else if (validation.num_frames > 0) {
    validation.rms =
        RmsPositionError(validation.trajectory, input.reference, validation.num_frames);
    validation.held_out_rms =
        RmsPositionError(validation.trajectory, input.reference, validation.num_frames,
                         summary.num_frames);
  }
  return validation;
}

std::vector<std::string> WriteResults(const EstimationJob& job,
                                      const EstimationInput& input,
                                      const EstimatorSummary& summary,
                                      const Validation& validation,
                                      const std::string& output_dir) {
  std::vector<std::string> files;
  if (HasResult(summary)) {
    files.push_back(output_dir + "/" + JobName(job, input.scene) + "_optimized.txt");
    SaveScene(summary.scene, files.back());
    const std::vector<std::string> frames =
        WriteTrajectory(TrajectoryPath(job, output_dir), job.trajectory_format,
                        validation.trajectory, summary.scene);
    files.insert(files.end(), frames.begin(), frames.end());
  }
  files.push_back(output_dir + "/report.json");
  WriteFileAtomically(files.back(), ReportToJson(job, input, summary, validation));
  return files;
}

}  // namespace dpe
