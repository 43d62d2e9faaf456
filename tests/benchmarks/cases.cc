#include "cases.h"

namespace dpe::bench {

Scene MakeScene(const Case& c) {
  PresetOptions options;
  options.rows = options.cols = c.plan.size;
  Scene scene = MakePresetScene(c.preset, options);
  scene.integration_method = c.method;
  scene.solver = c.solver;
  scene.tolerance = kTolerance;
  return scene;
}

namespace {

// Where the step matrices of fine grids are indefinite, or Newton's method needs many.
bool IsSlow(const Case& c) {
  const bool is_newton = c.method != IntegrationMethod::kLinearlyImplicitEuler;
  return (is_newton && c.plan.size > 96) ||
         (c.preset == ScenePreset::kFlag && c.plan.size > 48);
}

}  // namespace

std::string CaseName(const std::string& what, const Case& c) {
  return what + "/" + c.preset_name + "/" + c.solver +
         "/method:" + std::to_string(static_cast<int>(c.method)) +
         "/grid:" + std::to_string(c.plan.size) + (IsSlow(c) ? "/slow:1" : "");
}

}  // namespace dpe::bench
