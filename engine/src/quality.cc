#include "dpe/engine/quality.h"

#include <algorithm>
#include <cmath>

#include "dpe/engine/stable_step.h"

namespace dpe {
namespace {

constexpr double kPresetFrame = 0.02;  // s, the frame that StepSettings::steps is of

bool IsStableAtAnyStep(IntegrationMethod method) {
  return method != IntegrationMethod::kExplicitEuler &&
         method != IntegrationMethod::kSymplecticEuler;
}

}  // namespace

const std::array<QualityPreset, 4>& QualityPresets() {
  constexpr IntegrationMethod kSymplectic = IntegrationMethod::kSymplecticEuler;
  constexpr IntegrationMethod kTr = IntegrationMethod::kTrBdf2;
  static const std::array<QualityPreset, 4> presets = {{
      {Quality::kDraft,
       "draft",
       "to see what a scene does",
       {kSymplectic, 8},
       {kTr, 2}},
      {Quality::kStandard,
       "standard",
       "errors that cannot be seen",
       {kTr, 2, "cg", 1e-5, 1e-4},
       {kTr, 4}},
      {Quality::kAccurate,
       "accurate",
       "to compare with measurements of a millimetre",
       {kTr, 8, "cg", 1e-5, 1e-6},
       {kTr, 8}},
      {Quality::kReference,
       "reference",
       "to judge other settings by",
       {kTr, 32, "cg", 1e-5, 1e-6},
       {kTr, 32}},
  }};
  return presets;
}

const QualityPreset& PresetOf(Quality quality) {
  return QualityPresets()[static_cast<int>(quality)];
}

Quality QualityFromName(const std::string& name) {
  for (const QualityPreset& preset : QualityPresets()) {
    if (name == preset.name) return preset.quality;
  }
  throw SceneError("\"" + name +
                   "\" is not accepted; expected draft, standard, accurate or "
                   "reference");
}

void ApplyStepSettings(const StepSettings& settings, Scene* scene,
                       SimulatorOptions* options) {
  scene->integration_method = settings.method;
  // A frame of 20 ms that was rounded must not take a step more.
  const double steps = std::ceil(settings.steps * scene->delta / kPresetFrame - 1e-6);
  constexpr double kMostSteps = 1e9;  // no number of steps that a whole number is not
  scene->steps_per_frame = static_cast<int>(std::clamp(steps, 1.0, kMostSteps));
  scene->solver = settings.solver;
  scene->tolerance = settings.tolerance;
  if (options != nullptr) options->newton_tolerance = settings.newton_tolerance;
}

std::string QualityText(const std::string& name, const Scene& scene) {
  return "Quality " + name + ": " + IntegrationMethodName(scene.integration_method) +
         ", " + std::to_string(scene.steps_per_frame) +
         (scene.steps_per_frame == 1 ? " step" : " steps") + " per frame";
}

StepSettings SimulationSettings(Quality quality, const Scene& scene) {
  StepSettings settings = PresetOf(quality).simulation;
  if (IsStableAtAnyStep(settings.method)) return settings;
  const double needed = std::ceil(kPresetFrame / (kStableShare * StableStep(scene)));
  if (needed <= settings.steps) return settings;
  if (needed > kMaxStretch * settings.steps) {
    return SimulationSettings(static_cast<Quality>(static_cast<int>(quality) + 1),
                              scene);
  }
  settings.steps = static_cast<int>(needed);
  return settings;
}

}  // namespace dpe
