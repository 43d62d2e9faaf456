#include "dpe/engine/trajectory.h"

namespace dpe {

std::string RolloutStatus::Message() const {
  if (ok()) return "ok";
  const bool is_derivative = pass == Pass::kDerivative;
  std::string what;
  switch (code) {
    case Code::kOk:
      break;
    case Code::kNotFinite:
      what = is_derivative ? "the derivatives left the range of finite numbers"
                           : "the simulation left the range of finite numbers";
      break;
    case Code::kNewtonFailed:
      what = "Newton's method failed";
      break;
    case Code::kLinearSolverFailed:
      what = "the linear solver failed";
      break;
    case Code::kInterrupted:
      what = is_derivative ? "the derivative pass was interrupted"
                           : "the simulation was interrupted";
      break;
  }
  if (object >= 0) what += " in object " + std::to_string(object);
  if (frame >= 0) {
    what +=
        (step >= 0 ? " on the way to frame " : " at frame ") + std::to_string(frame);
  }
  if (step >= 0) what += ", step " + std::to_string(step);
  if (!reason.empty()) what += ": " + reason;
  return what;
}

}  // namespace dpe
