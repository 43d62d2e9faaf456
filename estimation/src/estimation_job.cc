#include "dpe/estimation/estimation_job.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "dpe/engine/parameters.h"
#include "dpe/engine/scene_io.h"
#include "dpe/engine/simulator.h"
#include "dpe/estimation/joint_layout.h"
#include "dpe/estimation/observed_scene.h"
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

// What LoadTarget lets the scene take over, of a target in memory.
Observations TakeTarget(const EstimationJob& job, size_t index, CaptureInput* capture) {
  const Observations& target = job.targets[index];
  if (job.target.start_from_target) StartFromObservation(target, &capture->scene);
  if (job.target.follow_pins) {
    FollowObservedPins(target, capture->target_path, &capture->scene);
  }
  ValidateScene(capture->scene, capture->target_path + " and the scene");
  return target;
}

void ReadTarget(const EstimationJob& job, size_t index, CaptureInput* capture,
                std::vector<std::string>* warnings) {
  capture->reference =
      job.targets.empty()
          ? LoadTarget(capture->target_path, job.target, &capture->scene, warnings)
          : TakeTarget(job, index, capture);
  const int in_file = capture->reference.num_frames();
  capture->num_frames = std::min(
      job.num_frames > 0 ? job.num_frames : capture->scene.num_frames, in_file);
  capture->num_validation_frames = std::min(job.num_validation_frames, in_file);
}

void MakeTarget(const EstimationJob& job, CaptureInput* capture) {
  capture->num_frames = job.num_frames > 0 ? job.num_frames : capture->scene.num_frames;
  capture->num_validation_frames = job.num_validation_frames;
  Simulator simulator(capture->scene, OptionsFor(job.options));
  const Trajectory truth =
      simulator.Simulate(std::max(capture->num_frames, capture->num_validation_frames));
  if (!truth.status.ok() && truth.status.frame < capture->num_frames) {
    throw SceneError(capture->scene_path +
                     ": the scene's own motion, which is to be the target, cannot be "
                     "simulated: " +
                     truth.status.Message());
  }
  capture->reference = ObserveAll(truth);
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

Scene TakeScene(const Scene& scene, const std::string& name,
                std::vector<std::string>* warnings) {
  ValidateScene(scene, name, warnings);
  return scene;
}

void ApplyQuality(const EstimationJob& job, bool made_of_target, Scene* scene) {
  if (!job.quality) return;
  const SceneFromTargetOptions& own = job.scene_from_target;
  ApplyStepSettings(PresetOf(*job.quality).estimation, scene, nullptr);
  if (!made_of_target) return;
  if (job.keep_integrator) scene->integration_method = own.integration_method;
  if (job.keep_steps_per_frame) scene->steps_per_frame = own.steps_per_frame;
}

// @param path          of the scene, or its name; empty: it is made of `target`
// @param given         if it is in memory
// @param input         receives warnings, and whose settings are to be chosen
Scene LoadJobScene(const EstimationJob& job, const std::string& path,
                   const Scene* given, const std::string& target,
                   EstimationInput* input) {
  Scene scene = given != nullptr ? TakeScene(*given, path, &input->warnings)
                : path.empty()
                    ? SceneFromTarget(target, job.target, job.scene_from_target)
                    : LoadScene(path, &input->warnings);
  ApplyQuality(job, given == nullptr && path.empty(), &scene);
  if (!job.settings.empty()) {
    input->auto_objects = ApplyAutoSettings(job.settings, &scene);
  }
  for (const std::string& what : job.estimate) EstimateMore(what, &scene);
  if (ParameterLayout(scene).size() == 0) {
    throw SceneError(
        (path.empty() ? target : path) + ": nothing is estimated (settings \"" +
        SettingsString(scene) +
        "\"); accepted in --settings are two letters per object, mass then "
        "stiffness, each n, G, L or R and not all n, or auto");
  }
  return scene;
}

// The paths; names for what is in memory: "scene", or "scene 1", ...
std::vector<std::string> Names(const std::vector<std::string>& paths, size_t in_memory,
                               const std::string& name) {
  if (in_memory == 0) return paths;
  std::vector<std::string> names;
  for (size_t i = 1; i <= in_memory; ++i) {
    names.push_back(in_memory == 1 ? name : name + " " + std::to_string(i));
  }
  return names;
}

// Captures with their scenes and the names of their targets.
std::vector<CaptureInput> PairScenesWithTargets(const EstimationJob& job,
                                                EstimationInput* input) {
  const std::vector<std::string> scenes =
      Names(job.scene_paths, job.scenes.size(), "scene");
  const std::vector<std::string> targets =
      Names(job.target_paths, job.targets.size(), "target");
  const size_t num_scenes = scenes.size();
  const size_t num_targets = targets.size();
  const bool is_one_for_all = num_scenes == 1 && num_targets > 1;
  const bool are_pairs = num_scenes == 0 || num_targets == 0;
  if (num_scenes + num_targets == 0 ||
      !(is_one_for_all || are_pairs || num_targets == num_scenes)) {
    throw SceneError("--scene and --target: there are " + std::to_string(num_scenes) +
                     " scenes and " + std::to_string(num_targets) +
                     " targets; accepted are a target for each scene, one scene for "
                     "all targets, or one of them only");
  }
  std::vector<CaptureInput> captures;
  for (size_t c = 0; c < std::max(num_scenes, num_targets); ++c) {
    CaptureInput capture;
    const size_t s = is_one_for_all ? 0 : c;
    if (num_targets > 0) capture.target_path = targets[c];
    if (num_scenes > 0) capture.scene_path = scenes[s];
    // What is to be said of one scene is to be said once.
    const bool is_known = is_one_for_all && c > 0;
    capture.scene = is_known
                        ? captures[0].scene
                        : LoadJobScene(job, capture.scene_path,
                                       job.scenes.empty() ? nullptr : &job.scenes[s],
                                       capture.target_path, input);
    captures.push_back(std::move(capture));
  }
  return captures;
}

void RequireFrames(const EstimationJob& job, const EstimationInput& input) {
  const CaptureInput* longest = nullptr;
  int most = 0;
  for (const CaptureInput& capture : input.captures) {
    if (capture.reference.num_frames() <= most) continue;
    most = capture.reference.num_frames();
    longest = &capture;
  }
  if (!input.truth_is_known && job.num_frames > most) {
    throw SceneError("--frames: " + std::to_string(job.num_frames) +
                     " asked for; accepted are 2 to " + std::to_string(most) +
                     ", the frames in " +
                     (longest != nullptr ? longest : &input.captures[0])->target_path);
  }
  for (const CaptureInput& capture : input.captures) {
    if (capture.num_frames >= 2) continue;
    throw SceneError("--frames: " + std::to_string(capture.num_frames) +
                     "; accepted are 2 or more (frame 0 is the initial state)");
  }
}

// "capture 2 (b.txt, b.csv)"
std::string CaptureName(const CaptureInput& capture, size_t index) {
  const bool has_both = !capture.scene_path.empty() && !capture.target_path.empty();
  return "capture " + std::to_string(index + 1) + " (" + capture.scene_path +
         (has_both ? ", " : "") + capture.target_path + ")";
}

std::vector<std::string> CaptureNames(const EstimationInput& input) {
  std::vector<std::string> names;
  for (const CaptureInput& capture : input.captures) {
    names.push_back(CaptureName(capture, names.size()));
  }
  return names;
}

void AddTargetNoise(const EstimationJob& job, size_t index, CaptureInput* capture) {
  // Far from the seeds that a user tries one after the other.
  constexpr std::uint64_t kNextSeed = 0x9E3779B97F4A7C15;
  capture->target = CutFrames(capture->reference, 0, capture->num_frames);
  if (job.sigma > 0.0) {
    capture->target.sigma = job.sigma;
  } else if (job.noise_sigma > 0.0) {
    capture->target.sigma = job.noise_sigma;
  }
  if (job.noise_sigma > 0.0) {
    AddNoise(capture->scene, job.noise_sigma, job.noise_seed + index * kNextSeed,
             &capture->target);
  }
}

Validation ValidateOne(const CaptureSummary& fitted, const CaptureInput& input,
                       int num_threads) {
  Validation validation;
  validation.rms = validation.held_out_rms = std::numeric_limits<double>::quiet_NaN();
  validation.num_frames = input.num_validation_frames;
  SimulatorOptions options;
  options.only_estimated_objects = true;
  options.num_threads = num_threads;
  Simulator simulator(fitted.scene, options);
  validation.trajectory =
      simulator.Simulate(std::max(fitted.num_frames, validation.num_frames));
  const RolloutStatus& status = validation.trajectory.status;
  if (!status.ok() && status.frame < validation.num_frames) {
    validation.note = "validation failed: " + status.Message();
  } else if (validation.num_frames > 0) {
    AddPositionErrors(validation.trajectory, input.reference, validation.num_frames,
                      &validation.errors);
    validation.rms = validation.errors.Rms();
    AddPositionErrors(validation.trajectory, input.reference, validation.num_frames,
                      &validation.held_out_errors, fitted.num_frames);
    validation.held_out_rms = validation.held_out_errors.Rms();
  }
  return validation;
}

}  // namespace

std::vector<const Scene*> EstimationInput::scenes() const {
  std::vector<const Scene*> scenes;
  for (const CaptureInput& capture : captures) scenes.push_back(&capture.scene);
  return scenes;
}

EstimationInput LoadEstimationInput(const EstimationJob& job) {
  EstimationInput input;
  input.captures = PairScenesWithTargets(job, &input);
  input.truth_is_known = job.target_paths.empty() && job.targets.empty();
  for (size_t c = 0; c < input.captures.size(); ++c) {
    if (input.truth_is_known) {
      MakeTarget(job, &input.captures[c]);
    } else {
      ReadTarget(job, c, &input.captures[c], &input.warnings);
    }
  }
  RequireFrames(job, input);
  RequireSameCloths(input.scenes(), CaptureNames(input));
  for (size_t c = 0; c < input.captures.size(); ++c) {
    AddTargetNoise(job, c, &input.captures[c]);
  }
  return input;
}

EstimatorSummary RunEstimation(const EstimatorOptions& options,
                               const std::function<void(const ModelFit&)>& started,
                               EstimationInput* input, ModelSelection* selection) {
  std::vector<CapturedMotion> captures;
  for (const CaptureInput& capture : input->captures) {
    captures.push_back(
        {capture.scene, capture.target, CaptureName(capture, captures.size())});
  }
  if (input->auto_objects.empty()) return Estimate(captures, options);
  ModelSelectionOptions selection_options;
  selection_options.objects = input->auto_objects;
  selection_options.started = started;
  SelectedModel model = SelectModel(captures, options, selection_options);
  for (CaptureInput& capture : input->captures) {
    ApplySettings(model.selection.chosen, &capture.scene);
  }
  *selection = std::move(model.selection);
  return std::move(model.summary);
}

std::vector<Validation> Validate(const EstimatorSummary& summary,
                                 const EstimationInput& input, int num_threads) {
  std::vector<Validation> validations(input.captures.size());
  const bool has_result = std::isfinite(summary.final_cost);
  for (size_t c = 0; c < validations.size(); ++c) {
    if (has_result) {
      validations[c] = ValidateOne(summary.captures[c], input.captures[c], num_threads);
    } else {
      validations[c].rms = std::numeric_limits<double>::quiet_NaN();
      validations[c].held_out_rms = validations[c].rms;
    }
  }
  return validations;
}

Validation Together(const std::vector<Validation>& validations) {
  Validation all;
  bool has_all = true;
  for (const Validation& one : validations) {
    all.num_frames = std::max(all.num_frames, one.num_frames);
    all.errors.sum += one.errors.sum;
    all.errors.count += one.errors.count;
    all.held_out_errors.sum += one.held_out_errors.sum;
    all.held_out_errors.count += one.held_out_errors.count;
    if (all.note.empty()) all.note = one.note;
    has_all &= std::isfinite(one.rms);
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  all.rms = has_all ? all.errors.Rms() : nan;
  all.held_out_rms = has_all ? all.held_out_errors.Rms() : nan;
  return all;
}

}  // namespace dpe
