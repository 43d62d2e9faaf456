#include "starting_point.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "dpe/estimation/inverse_dynamics.h"

namespace dpe {
namespace {

Eigen::VectorXd UniformParameters(const ParameterLayout& layout, double value) {
  Eigen::VectorXd parameters = Eigen::VectorXd::Zero(layout.size());
  for (const ParameterBlock& block : layout.blocks()) {
    if (!ParameterKindIsPositive(block.kind)) continue;
    parameters.segment(block.offset, block.size).setConstant(value);
  }
  return parameters;
}

StartingPoint FromParameters(const Eigen::VectorXd& parameters, const std::string& init,
                             const ParameterMap& map) {
  StartingPoint start;
  start.ok = true;
  start.init = init;
  int num_raised = 0;
  start.coordinates = map.ToCoordinates(parameters, &num_raised);
  if (num_raised > 0) {
    start.notes.push_back(std::to_string(num_raised) +
                          " starting values below 1e-12 were raised to it: they are "
                          "optimised by their logarithm");
  }
  return start;
}

// `priors` decide the scale of what motion alone leaves free, after this start.
StartingPoint FromInverseDynamics(const Scene& scene, const Observations& observations,
                                  const std::vector<Prior>& priors,
                                  TrajectoryEvaluator* evaluator) {
  const std::vector<double> free_mass = FreeMass(scene);
  InverseDynamicsResult result = SolveInverseDynamics(
      evaluator->simulator(), observations, evaluator->num_frames(), free_mass);
  const std::vector<double> to_keep = MassToKeep(scene, priors);
  for (size_t object = 0; object < to_keep.size(); ++object) {
    if (!std::isnan(to_keep[object])) continue;
    const std::string note = ScaleNote(static_cast<int>(object), free_mass[object]);
    result.notes.erase(std::remove(result.notes.begin(), result.notes.end(), note),
                       result.notes.end());
  }
  StartingPoint start;
  start.init = "inverse_dynamics";
  start.message = result.message;
  if (!result.ok) return start;
  start = FromParameters(result.parameters, start.init, evaluator->map());
  start.notes.insert(start.notes.begin(), result.notes.begin(), result.notes.end());
  if (scene.steps_per_frame > 1) {
    start.notes.push_back(
        "inverse dynamics took each frame as one step: a start, not the answer");
  }
  return start;
}

// Inverse dynamics where it applies and its result can be simulated, else the screen
// for few parameters, else the scene's values.
StartingPoint FindAutomatically(const Scene& scene, const Observations& observations,
                                const EstimatorOptions& options, StopControl* stop,
                                TrajectoryEvaluator* evaluator) {
  std::vector<std::string> notes;
  if (InverseDynamicsApplies(scene, observations)) {
    StartingPoint start =
        FromInverseDynamics(scene, observations, options.priors, evaluator);
    if (start.ok && evaluator->Evaluate(start.coordinates)) return start;
    if (stop->stopped()) return start;
    notes.push_back("the start from inverse dynamics could not be used: " +
                    (start.ok ? evaluator->message() : start.message));
  }
  EstimatorOptions fallback = options;
  fallback.init = evaluator->num_parameters() <= options.max_screen_parameters
                      ? InitMethod::kScreen
                      : InitMethod::kScene;
  StartingPoint start =
      FindStartingPoint(scene, observations, fallback, stop, evaluator);
  start.notes.insert(start.notes.begin(), notes.begin(), notes.end());
  return start;
}

}  // namespace

StartingPoint FindStartingPoint(const Scene& scene, const Observations& observations,
                                const EstimatorOptions& options, StopControl* stop,
                                TrajectoryEvaluator* evaluator) {
  const ParameterLayout& layout = evaluator->layout();
  if (options.start.size() > 0) {
    if (options.start.size() != layout.size()) {
      throw SceneError("the start that was given has " +
                       std::to_string(options.start.size()) + " values for " +
                       std::to_string(layout.size()) + " parameters");
    }
    return FromParameters(options.start, "given", evaluator->map());
  }
  switch (options.init) {
    case InitMethod::kInverseDynamics:
      return FromInverseDynamics(scene, observations, options.priors, evaluator);
    case InitMethod::kScene:
      return FromParameters(layout.Extract(scene), "scene", evaluator->map());
    case InitMethod::kUniform:
      return FromParameters(UniformParameters(layout, options.uniform_value), "uniform",
                            evaluator->map());
    case InitMethod::kScreen:
      return ScreenStartingPoints(stop, evaluator);
    case InitMethod::kAuto:
      break;
  }
  return FindAutomatically(scene, observations, options, stop, evaluator);
}

}  // namespace dpe
