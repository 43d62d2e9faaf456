#include "cases.h"

namespace dpe::bench {

Scene MakeScene(const Case& c) {
  PresetOptions options;
  options.rows = options.cols = c.plan.size;
  Scene scene = MakePresetScene(c.preset, options);
  scene.integration_method = c.method;
  return scene;
}

SimulatorOptions MakeOptions() {
  SimulatorOptions options;
  options.newton_tolerance = kNewtonTolerance;
  return options;
}

std::string CaseName(const std::string& what, const Case& c) {
  return what + "/" + c.preset_name +
         "/method:" + std::to_string(static_cast<int>(c.method)) +
         "/grid:" + std::to_string(c.plan.size);
}

}  // namespace dpe::bench
