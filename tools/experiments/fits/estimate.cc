#include "experiments/fits/estimate.h"

#include <cmath>
#include <string>
#include <vector>

#include "dpe/estimation/robust_loss.h"
#include "experiments/arguments.h"
#include "experiments/fits/fit_row.h"
#include "experiments/fits/job_scene.h"
#include "support/estimator_names.h"
#include "support/flag_ranges.h"
#include "support/flag_values.h"

namespace dpe::experiments {
namespace {

std::vector<std::string> KnownArguments() {
  std::vector<std::string> names = {"settings",
                                    "estimate",
                                    "target",
                                    "frames",
                                    "validate_frames",
                                    "init",
                                    "solver",
                                    "jacobian",
                                    "horizon",
                                    "uncertainty",
                                    "noise_sigma",
                                    "sigma",
                                    "seed",
                                    "loss",
                                    "loss_scale",
                                    "prior",
                                    "smoothness",
                                    "max_iterations",
                                    "max_seconds",
                                    "init_perturbation",
                                    "memory_limit",
                                    "target_scale",
                                    "target_up",
                                    "target_rate",
                                    "target_object",
                                    "marker_map",
                                    "marker_limit",
                                    "follow_pins",
                                    "initial_state"};
  const std::vector<std::string>& scene = JobSceneArguments();
  names.insert(names.begin(), scene.begin(), scene.end());
  return names;
}

// What `read` makes of a text argument; its error is made to name the argument.
template <typename Function>
auto Named(const Job& job, const std::string& key, const std::string& missing,
           Function read) {
  const std::string value = job.Text(key, missing);
  try {
    return read(value);
  } catch (const SceneError& error) {
    throw SceneError(key + ": " + error.what());
  }
}

double AtLeast(const Job& job, const std::string& key, double missing, double least) {
  const double value = job.Number(key, missing);
  if (value >= least && std::isfinite(value)) return value;
  throw SceneError(key + ": " + std::to_string(value) +
                   " is not accepted; expected a finite number of at least " +
                   std::to_string(least));
}

int CountAtLeast(const Job& job, const std::string& key, int missing, int least) {
  AtLeast(job, key, missing, least);
  return job.Integer(key, missing);
}

TargetOptions TargetOf(const Job& job) {
  TargetOptions target;
  target.capture.scale = AtLeast(job, "target_scale", 0.0, 0.0);
  target.capture.up = Named(job, "target_up", "y", UpAxisFromName);
  target.capture.rate = AtLeast(job, "target_rate", 0.0, 0.0);
  target.attach.object = CountAtLeast(job, "target_object", -1, -1);
  target.attach.max_distance = AtLeast(job, "marker_limit", 0.0, 0.0);
  target.marker_map = job.Text("marker_map", "");
  target.follow_pins = job.Flag("follow_pins", false);
  target.start_from_target = Named(job, "initial_state", "scene", [](const auto& name) {
    if (name != "scene" && name != "target") {
      throw SceneError("\"" + name + "\" is not accepted; expected scene or target");
    }
    return name == "target";
  });
  return target;
}

EstimatorOptions OptionsOf(const Job& job) {
  EstimatorOptions options;
  options.solver = Named(job, "solver", "auto", tools::SolverFromName);
  options.jacobian = Named(job, "jacobian", "auto", tools::JacobianFromName);
  options.horizon = Named(job, "horizon", "auto", tools::HorizonFromName);
  options.uncertainty = Named(job, "uncertainty", "off", tools::UncertaintyFromName);
  const tools::Start start = Named(job, "init", "auto", tools::StartFromName);
  options.init = start.method;
  options.uniform_value = start.uniform_value;
  options.init_perturbation = AtLeast(job, "init_perturbation", 0.0, 0.0);
  options.seed = static_cast<std::uint64_t>(CountAtLeast(job, "seed", 0, 0));
  options.loss = Named(job, "loss", "none", LossTypeFromName);
  options.loss_scale = AtLeast(job, "loss_scale", 0.0, 0.0);
  options.priors = Named(job, "prior", "", PriorsFromText);
  options.smoothness = Named(job, "smoothness", "", SmoothnessFromText);
  options.max_iterations = CountAtLeast(job, "max_iterations", -1, -1);
  options.max_seconds = AtLeast(job, "max_seconds", 1e9, 0.0);
  const int mib = CountAtLeast(job, "memory_limit", 2048, 0);
  options.memory_limit_bytes = static_cast<std::size_t>(mib) << 20;
  return options;
}

Record Run(const Job& job) {
  EstimationJob estimation = EstimationOf(job);
  const JobScenes scenes(job, /*is_required=*/!job.Has("target"));
  estimation.scene_paths = scenes.paths();
  EstimationInput input = LoadEstimationInput(estimation);
  ModelSelection selection;
  const EstimatorSummary summary = RunEstimation(
      estimation.options, [](const ModelFit&) {}, &input, &selection);
  return FitRow(summary, input, Validate(summary, input, 1), &selection);
}

}  // namespace

EstimationJob EstimationOf(const Job& job) {
  RequireKnownArguments(job, KnownArguments());
  EstimationJob estimation;
  estimation.settings = job.Text("settings", "");
  estimation.estimate = tools::Split(job.Text("estimate", ""), ',');
  estimation.target_paths = tools::Split(job.Text("target", ""), ',');
  estimation.target = TargetOf(job);
  estimation.num_frames = CountAtLeast(job, "frames", 0, 0);
  estimation.num_validation_frames = CountAtLeast(job, "validate_frames", 0, 0);
  estimation.noise_sigma = AtLeast(job, "noise_sigma", 0.0, 0.0);
  estimation.sigma = AtLeast(job, "sigma", 0.0, 0.0);
  estimation.options = OptionsOf(job);
  estimation.noise_seed = estimation.options.seed;
  return estimation;
}

JobKind EstimateKind() {
  return {"estimate", "one fit, as estimate_cloth makes it", Run};
}

}  // namespace dpe::experiments
