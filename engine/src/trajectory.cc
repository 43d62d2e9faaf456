#include "dpe/engine/trajectory.h"

namespace dpe {

std::string RolloutStatus::Message() const {
  if (ok()) return "ok";
  std::string what;
  switch (code) {
    case Code::kOk:
      break;
    case Code::kNotFinite:
      what = "the simulation left the range of finite numbers";
      break;
    case Code::kNewtonFailed:
      what = "Newton's method failed";
      break;
    case Code::kLinearSolverFailed:
      what = "the linear solver failed";
      break;
    case Code::kInterrupted:
      what = "the simulation was interrupted";
      break;
  }
  what += " in object " + std::to_string(object) + " on the way to frame " +
          std::to_string(frame) + ", step " + std::to_string(step);
  if (!reason.empty()) what += ": " + reason;
  return what;
}

}  // namespace dpe
