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
       {kSymplectic, 8, "auto", 1e-5, 1e-13},
       {kTr, 1, "auto", 1e-5, 1e-13}},
      {Quality::kStandard,
       "standard",
       "errors below what a camera sees",
       {kTr, 2, "auto", 1e-5, 1e-4},
       {kTr, 2, "auto", 1e-5, 1e-13}},
      {Quality::kAccurate,
       "accurate",
       "to compare with measurements of a millimetre and less",
       {kTr, 8, "auto", 1e-8, 1e-6},
       {kTr, 4, "auto", 1e-8, 1e-13}},
      {Quality::kReference,
       "reference",
       "to judge other settings by",
       {kTr, 32, "auto", 1e-12, 1e-13},
       {kTr, 16, "auto", 1e-12, 1e-13}},
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
  const double steps = settings.steps * scene->delta / kPresetFrame;
  scene->steps_per_frame = std::max(1, static_cast<int>(std::ceil(steps - 1e-6)));
  scene->solver = settings.solver;
  scene->tolerance = settings.tolerance;
  if (options != nullptr) options->newton_tolerance = settings.newton_tolerance;
}

StepSettings SimulationSettings(Quality quality, const Scene& scene) {
  StepSettings settings = PresetOf(quality).simulation;
  if (IsStableAtAnyStep(settings.method)) return settings;
  const double needed = std::ceil(kPresetFrame / StableStep(scene));
  if (needed <= settings.steps) return settings;
  if (needed > kMaxStretch * settings.steps) {
    return SimulationSettings(static_cast<Quality>(static_cast<int>(quality) + 1),
                              scene);
  }
  settings.steps = static_cast<int>(needed);
  return settings;
}

}  // namespace dpe
