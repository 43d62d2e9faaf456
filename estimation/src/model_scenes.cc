#include "model_scenes.h"

#include <algorithm>

#include "dpe/estimation/joint_layout.h"

namespace dpe {

Scenes ScenesOf(const Captures& captures) {
  Scenes scenes;
  for (const CapturedMotion& capture : captures) scenes.push_back(capture.scene);
  return scenes;
}

Scenes FittedScenes(const EstimatorSummary& summary) {
  Scenes scenes;
  for (const CaptureSummary& capture : summary.captures)
    scenes.push_back(capture.scene);
  return scenes;
}

void SetMode(int object, ParameterMode mode, Scenes* scenes) {
  for (Scene& scene : *scenes) scene.objects[object].stiffness_mode = mode;
}

Captures In(const Scenes& scenes, Captures captures) {
  for (size_t c = 0; c < captures.size(); ++c) captures[c].scene = scenes[c];
  return captures;
}

Captures WithModesOf(const Scenes& modes, Captures captures) {
  for (size_t c = 0; c < captures.size(); ++c) {
    Scene& scene = captures[c].scene;
    for (size_t i = 0; i < scene.objects.size(); ++i) {
      scene.objects[i].stiffness_mode = modes[c].objects[i].stiffness_mode;
    }
  }
  return captures;
}

ParameterLayout LayoutOf(const Scenes& scenes) {
  std::vector<const Scene*> pointers;
  for (const Scene& scene : scenes) pointers.push_back(&scene);
  return JointLayout(pointers, /*own_wind=*/true).layout();
}

bool HasElements(const Scenes& scenes) {
  const ParameterLayout layout = LayoutOf(scenes);
  return std::any_of(
      layout.blocks().begin(), layout.blocks().end(),
      [](const ParameterBlock& block) { return block.mode == ParameterMode::kLocal; });
}

bool HasElements(const Scenes& scenes, ParameterKind kind, int object) {
  const ParameterLayout layout = LayoutOf(scenes);
  return std::any_of(
      layout.blocks().begin(), layout.blocks().end(), [&](const ParameterBlock& block) {
        return block.mode == ParameterMode::kLocal && block.kind == kind &&
               (object < 0 || block.object == object);
      });
}

}  // namespace dpe
