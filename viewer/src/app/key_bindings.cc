#include "app/key_bindings.h"

#include <GLFW/glfw3.h>

namespace dpe::viewer {

KeyBinding BindingOf(int key) {
  if (key >= GLFW_KEY_1 && key < GLFW_KEY_1 + kNumColorModes) {
    return {Action::kNone, static_cast<ColorMode>(key - GLFW_KEY_1), false};
  }
  switch (key) {
    case GLFW_KEY_W:
      return {Action::kZoomIn, {}, true};
    case GLFW_KEY_S:
      return {Action::kZoomOut, {}, true};
    case GLFW_KEY_R:
      return {Action::kResetCamera, {}, false};
    case GLFW_KEY_F:
      return {Action::kFrame, {}, false};
    case GLFW_KEY_ESCAPE:
      return {Action::kQuit, {}, false};
    case GLFW_KEY_SPACE:
      return {Action::kTogglePause, {}, false};
    case GLFW_KEY_RIGHT:
      return {Action::kStepForward, {}, true};
    case GLFW_KEY_LEFT:
      return {Action::kStepBack, {}, true};
    case GLFW_KEY_HOME:
      return {Action::kRestart, {}, false};
    case GLFW_KEY_P:
      return {Action::kSavePng, {}, false};
    case GLFW_KEY_H:
      return {Action::kHelp, {}, false};
    default:
      return {};
  }
}

}  // namespace dpe::viewer
