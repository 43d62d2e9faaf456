// Which key does what.
#ifndef DPE_VIEWER_APP_KEY_BINDINGS_H_
#define DPE_VIEWER_APP_KEY_BINDINGS_H_

#include <optional>

#include "app/session.h"

namespace dpe::viewer {

struct KeyBinding {
  Action action = Action::kNone;
  std::optional<ColorMode> color;
  bool repeats = false;  // while the key is held down
};

// @param key  of GLFW
KeyBinding BindingOf(int key);

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_APP_KEY_BINDINGS_H_
