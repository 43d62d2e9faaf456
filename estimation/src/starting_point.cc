#include "starting_point.h"

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

StartingPoint FromInverseDynamics(const Scene& scene, const Observations& observations,
                                  TrajectoryEvaluator* evaluator) {
  InverseDynamicsResult result = SolveInverseDynamics(
      evaluator->simulator(), observations, evaluator->num_frames(), FreeMass(scene));
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
    StartingPoint start = FromInverseDynamics(scene, observations, evaluator);
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
  switch (options.init) {
    case InitMethod::kInverseDynamics:
      return FromInverseDynamics(scene, observations, evaluator);
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
