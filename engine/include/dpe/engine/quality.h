// Named settings of the time stepping: what a simulation may cost, and how far from the
// exact motion it then is.
//
// Each preset is one that no other setting of the measured grid beats, being both
// cheaper and more accurate (docs/quality.md says what they cost and give, and how that
// was measured).
#ifndef DPE_ENGINE_QUALITY_H_
#define DPE_ENGINE_QUALITY_H_

#include <array>
#include <string>

#include "dpe/engine/export.h"
#include "dpe/engine/scene.h"
#include "dpe/engine/simulator.h"

namespace dpe {

enum class Quality { kDraft, kStandard, kAccurate, kReference };

// Everything on which the error and the cost of a rollout depend, beside the scene.
struct StepSettings {
  IntegrationMethod method = IntegrationMethod::kTrBdf2;
  // In a frame of 20 ms. What matters is the length of a step: longer frames take
  // proportionally more steps, shorter ones as many fewer as whole numbers allow.
  int steps = 1;
  std::string solver = "auto";  // as Scene::solver
  double tolerance = 1e-5;      // as Scene::tolerance; read by the Krylov solver only
  double newton_tolerance = 1e-13;  // as SimulatorOptions::newton_tolerance
};

struct QualityPreset {
  Quality quality;
  const char* name;     // "draft"
  const char* summary;  // what it is for, one sentence
  StepSettings simulation;
  // For fits to a motion that this program did not make itself. Never an explicit
  // method: stiffnesses that an optimiser tries may be far above those that are stable.
  // Newton's tolerance is the default there: derivatives are as exact as it is.
  StepSettings estimation;
};

DPE_ENGINE_API const std::array<QualityPreset, 4>& QualityPresets();
DPE_ENGINE_API const QualityPreset& PresetOf(Quality quality);

// draft, standard, accurate or reference.
// @throws SceneError naming these
DPE_ENGINE_API Quality QualityFromName(const std::string& name);

// Lets the settings take the place of the scene's and, unless null, of the options'.
DPE_ENGINE_API void ApplyStepSettings(const StepSettings& settings, Scene* scene,
                                      SimulatorOptions* options);

// The preset's settings for a simulation of this scene. Symplectic Euler is unstable
// beyond a certain step length: where kStableShare of what is stable at the start
// (StableStep) lies below the preset's, the steps are made shorter, and where that
// takes more than kMaxStretch times as many, the next preset, which is stable at any
// step, takes over.
constexpr int kMaxStretch = 4;
constexpr double kStableShare = 0.7;
DPE_ENGINE_API StepSettings SimulationSettings(Quality quality, const Scene& scene);

// "Quality draft: symplectic_euler, 8 steps per frame", of a scene that has its
// settings.
DPE_ENGINE_API std::string QualityText(const std::string& name, const Scene& scene);

}  // namespace dpe

#endif  // DPE_ENGINE_QUALITY_H_
