// Ranges of numeric flags. All throw SceneError naming the flag, its value and what is
// accepted.
#ifndef DPE_TOOLS_SUPPORT_FLAG_RANGES_H_
#define DPE_TOOLS_SUPPORT_FLAG_RANGES_H_

#include <cmath>
#include <sstream>
#include <string>

#include "dpe/engine/scene.h"

namespace dpe::tools {

// @param flag   name without dashes
// @param least  the smallest value that is accepted
template <typename Number>
void RequireAtLeast(const std::string& flag, Number value, Number least) {
  if (value >= least && std::isfinite(static_cast<double>(value))) return;
  std::ostringstream message;
  message << "--" << flag << ": " << value << " is not accepted; expected a finite "
          << "number of at least " << least;
  throw SceneError(message.str());
}

}  // namespace dpe::tools

#endif  // DPE_TOOLS_SUPPORT_FLAG_RANGES_H_
