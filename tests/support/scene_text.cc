#include "support/scene_text.h"

#include <stdexcept>

#include "dpe/engine/scene_io.h"

namespace dpe::test {

std::string SmallSceneText() {
  return R"({
  "title": "small",
  "delta": 0.02,
  "integrationMethod": 2,
  "tolerance": 1e-5,
  "optimizationIterations": 10,
  "forwardSubSteps": 3,
  "printTimes": true,
  "windVel": {"x": 1.5, "y": 0, "z": -2},
  "objects": [{
    "vertPos": [{"x": 0, "y": 0, "z": 0}, {"x": 1, "y": 0, "z": 0},
                {"x": 0, "y": 0, "z": 1}],
    "vertIsFixed": [true, false, false],
    "vertMass": [0.5, 0.25, 0.125],
    "springs": [0, 1, 1, 2],
    "springStiffness": [10, 20],
    "triangles": [0, 1, 2],
    "dragCoefficient": 0.3,
    "damping": 0.2,
    "optimizationSettings": "nL"
  }],
  "colliders": [{"type": 1, "pos": {"x": 0, "y": -3, "z": 0},
                 "rot": {"x": 0, "y": 0, "z": 0}, "scale": {"x": 2, "y": 2, "z": 2}}]
}
)";
}

std::string EditedSceneText(const std::string& from, const std::string& to) {
  std::string text = SmallSceneText();
  const size_t position = text.find(from);
  if (position == std::string::npos ||
      text.find(from, position + 1) != std::string::npos) {
    throw std::runtime_error("the small scene does not have exactly one " + from);
  }
  return text.replace(position, from.size(), to);
}

std::string SceneErrorOf(const std::string& text) {
  try {
    ParseScene(text, "scene.txt");
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

}  // namespace dpe::test
