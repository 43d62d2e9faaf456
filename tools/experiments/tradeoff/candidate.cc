#include "experiments/tradeoff/candidate.h"

#include <cmath>
#include <cstdio>
#include <map>

#include "dpe/engine/cloth_builder.h"

namespace dpe::experiments::tradeoff {
namespace {

std::string Short(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof(buffer), "%g", value);
  return buffer;
}

// Values that differ by rounding count as equal. They must be positive.
std::vector<int> GroupsOfEqualValues(const Eigen::VectorXd& values) {
  const auto key = [](double value) { return std::llround(1e6 * std::log(value)); };
  std::map<long long, int> group_of;
  for (double value : values) group_of.emplace(key(value), 0);
  int next = 0;
  for (auto& [value, group] : group_of) group = next++;
  std::vector<int> groups;
  for (double value : values) groups.push_back(group_of[key(value)]);
  return groups;
}

}  // namespace

bool UsesNewton(IntegrationMethod method) {
  return method == IntegrationMethod::kImplicitEuler ||
         method == IntegrationMethod::kTrBdf2;
}

bool UsesLinearSolver(IntegrationMethod method) {
  return UsesNewton(method) || method == IntegrationMethod::kLinearlyImplicitEuler;
}

Candidate CandidateFromRecord(const Record& record) {
  Candidate candidate;
  StepSettings& settings = candidate.settings;
  candidate.scene = record.Text("scene", candidate.scene);
  candidate.resolution = record.Integer("resolution", candidate.resolution);
  candidate.frames = record.Integer("frames", candidate.frames);
  settings.method = IntegrationMethodFromName(
      record.Text("integrator", IntegrationMethodName(settings.method)));
  settings.steps = record.Integer("steps", settings.steps);
  settings.solver = record.Text("solver", settings.solver);
  settings.tolerance = record.Number("tolerance", settings.tolerance);
  settings.newton_tolerance =
      record.Number("newton_tolerance", settings.newton_tolerance);
  candidate.max_newton_iterations =
      record.Integer("newton_iterations", candidate.max_newton_iterations);
  return candidate;
}

void SetCandidate(const Candidate& candidate, Record* record) {
  const StepSettings& settings = candidate.settings;
  record->Set("scene", candidate.scene);
  record->Set("resolution", candidate.resolution);
  record->Set("frames", candidate.frames);
  record->Set("integrator", IntegrationMethodName(settings.method));
  record->Set("steps", settings.steps);
  record->Set("solver", settings.solver);
  record->Set("tolerance", settings.tolerance);
  record->Set("newton_tolerance", settings.newton_tolerance);
  record->Set("newton_iterations", candidate.max_newton_iterations);
}

std::string SettingsText(const StepSettings& settings) {
  std::string text =
      IntegrationMethodName(settings.method) + " x" + std::to_string(settings.steps);
  if (UsesLinearSolver(settings.method)) {
    text += " " + settings.solver;
    if (settings.solver == "cg") text += " " + Short(settings.tolerance);
  }
  if (UsesNewton(settings.method)) {
    text += " newton " + Short(settings.newton_tolerance);
  }
  return text;
}

Scene CandidateScene(const Candidate& candidate, bool uniform) {
  PresetOptions options;
  options.rows = options.cols = candidate.resolution;
  Scene scene = MakePresetScene(ScenePresetFromName(candidate.scene), options);
  ClothObject& cloth = scene.objects[0];
  if (uniform) cloth.stiffness.setConstant(cloth.stiffness.mean());
  cloth.spring_group = GroupsOfEqualValues(cloth.stiffness);
  cloth.vertex_group = GroupsOfEqualValues(cloth.mass);
  ApplyStepSettings(candidate.settings, &scene, nullptr);
  return scene;
}

SimulatorOptions CandidateOptions(const Candidate& candidate) {
  SimulatorOptions options;
  options.newton_tolerance = candidate.settings.newton_tolerance;
  options.max_newton_iterations = candidate.max_newton_iterations;
  return options;
}

}  // namespace dpe::experiments::tradeoff
