#include "starting_point.h"

#include <algorithm>
#include <cmath>

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

// Those captures that are observed completely.
std::vector<int> CompleteCaptures(const std::vector<FitCapture>& captures) {
  std::vector<int> complete;
  for (int c = 0; c < static_cast<int>(captures.size()); ++c) {
    if (InverseDynamicsApplies(captures[c].blank, captures[c].observations)) {
      complete.push_back(c);
    }
  }
  return complete;
}

// Initial positions that are estimated of captures that inverse dynamics has not seen.
void StartWhereScenesDo(const std::vector<FitCapture>& captures,
                        const JointLayout& joint, const std::vector<int>& seen,
                        Eigen::VectorXd* parameters) {
  if (seen.size() == captures.size()) return;
  const Eigen::VectorXd values = joint.Extract(ScenesOf(captures));
  for (const ParameterBlock& block : joint.layout().blocks()) {
    const bool is_seen =
        std::find(seen.begin(), seen.end(), block.segment) != seen.end();
    if (block.kind != ParameterKind::kInitialPosition || is_seen) continue;
    parameters->segment(block.offset, block.size) =
        values.segment(block.offset, block.size);
  }
}

// Where a prior fixes the scale, no mass is kept.
void RemoveScaleNotes(const std::vector<double>& free_mass,
                      const std::vector<double>& to_keep,
                      std::vector<std::string>* notes) {
  for (size_t object = 0; object < to_keep.size(); ++object) {
    if (!std::isnan(to_keep[object])) continue;
    const std::string note = ScaleNote(static_cast<int>(object), free_mass[object]);
    notes->erase(std::remove(notes->begin(), notes->end(), note), notes->end());
  }
}

// Priors decide the scale of what motion alone leaves free, after this start.
StartingPoint FromInverseDynamics(const StartContext& context) {
  const std::vector<FitCapture>& captures = *context.captures;
  TrajectoryEvaluator* evaluator = context.evaluator;
  std::vector<int> complete = CompleteCaptures(captures);
  // Which is then refused, and why it was.
  if (complete.empty()) complete = {0};
  std::vector<InverseDynamicsMotion> motions;
  int num_framewise = 0;  // with frames of several steps
  for (const int c : complete) {
    motions.push_back({evaluator->simulator(c), &captures[c].observations,
                       evaluator->num_frames(c), c});
    if (captures[c].blank.steps_per_frame > 1) ++num_framewise;
  }
  const std::vector<double> free_mass = FreeMass(*context.given);
  InverseDynamicsResult result =
      SolveInverseDynamics(motions, evaluator->joint_layout(), free_mass);
  RemoveScaleNotes(free_mass, MassToKeep(*context.given, context.options->priors),
                   &result.notes);
  StartingPoint start;
  start.init = "inverse_dynamics";
  start.message = result.message;
  if (!result.ok) return start;
  StartWhereScenesDo(captures, evaluator->joint_layout(), complete, &result.parameters);
  start = FromParameters(result.parameters, start.init, evaluator->map());
  start.notes.insert(start.notes.begin(), result.notes.begin(), result.notes.end());
  if (num_framewise > 0) {
    start.notes.push_back(
        "inverse dynamics took each frame as one step: a start, not the answer");
  }
  if (complete.size() < captures.size()) {
    start.notes.push_back(
        "inverse dynamics is of those " + std::to_string(complete.size()) + " of " +
        std::to_string(captures.size()) + " captures that are observed completely");
  }
  return start;
}

// Inverse dynamics where it applies and its result can be simulated, else the screen
// for few parameters, else the scene's values.
StartingPoint FindAutomatically(const StartContext& context) {
  TrajectoryEvaluator* evaluator = context.evaluator;
  std::vector<std::string> notes;
  if (!CompleteCaptures(*context.captures).empty()) {
    StartingPoint start = FromInverseDynamics(context);
    if (start.ok && evaluator->Evaluate(start.coordinates)) return start;
    if (context.stop->stopped()) return start;
    notes.push_back("the start from inverse dynamics could not be used: " +
                    (start.ok ? evaluator->message() : start.message));
  }
  EstimatorOptions fallback = *context.options;
  fallback.init = evaluator->num_parameters() <= fallback.max_screen_parameters
                      ? InitMethod::kScreen
                      : InitMethod::kScene;
  StartContext with_fallback = context;
  with_fallback.options = &fallback;
  StartingPoint start = FindStartingPoint(with_fallback);
  start.notes.insert(start.notes.begin(), notes.begin(), notes.end());
  return start;
}

// The scenes' own values.
Eigen::VectorXd SceneParameters(const StartContext& context) {
  std::vector<const Scene*> scenes;
  for (const CaptureView& capture : *context.given) scenes.push_back(capture.scene);
  return context.evaluator->joint_layout().Extract(scenes);
}

StartingPoint GivenStart(const StartContext& context) {
  const Eigen::VectorXd& start = context.options->start;
  const ParameterMap& map = context.evaluator->map();
  if (start.size() != map.size()) {
    throw SceneError("the start that was given has " + std::to_string(start.size()) +
                     " values for " + std::to_string(map.size()) + " parameters");
  }
  return FromParameters(start, "given", map);
}

}  // namespace

bool AllAreComplete(const std::vector<FitCapture>& captures) {
  return CompleteCaptures(captures).size() == captures.size();
}

StartingPoint FindStartingPoint(const StartContext& context) {
  TrajectoryEvaluator* evaluator = context.evaluator;
  if (context.options->start.size() > 0) return GivenStart(context);
  switch (context.options->init) {
    case InitMethod::kInverseDynamics:
      return FromInverseDynamics(context);
    case InitMethod::kScene:
      return FromParameters(SceneParameters(context), "scene", evaluator->map());
    case InitMethod::kUniform:
      return FromParameters(
          UniformParameters(evaluator->layout(), context.options->uniform_value),
          "uniform", evaluator->map());
    case InitMethod::kScreen:
      return ScreenStartingPoints(context.stop, evaluator);
    case InitMethod::kAuto:
      break;
  }
  return FindAutomatically(context);
}

}  // namespace dpe
