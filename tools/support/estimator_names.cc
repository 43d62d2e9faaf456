#include "support/estimator_names.h"

#include <cmath>
#include <sstream>

#include "dpe/engine/scene.h"

namespace dpe::tools {
namespace {

constexpr char kUniform[] = "uniform:";

[[noreturn]] void Refuse(const std::string& value, const std::string& accepted) {
  throw SceneError("\"" + value + "\" is not accepted; expected " + accepted);
}

Start UniformStart(const std::string& name) {
  std::istringstream text(name.substr(sizeof(kUniform) - 1));
  double value = 0.0;
  text >> value;
  if (!text || text.peek() != std::istringstream::traits_type::eof() ||
      !std::isfinite(value) || value <= 0.0) {
    Refuse(name, "a number above 0 after uniform:");
  }
  return {InitMethod::kUniform, value};
}

}  // namespace

SolverType SolverFromName(const std::string& name) {
  if (name == "auto") return SolverType::kAuto;
  if (name == "lm") return SolverType::kLevenbergMarquardt;
  if (name == "lbfgs") return SolverType::kLbfgs;
  Refuse(name, "auto, lm or lbfgs");
}

JacobianMethod JacobianFromName(const std::string& name) {
  if (name == "auto") return JacobianMethod::kAuto;
  if (name == "adjoint") return JacobianMethod::kAdjoint;
  if (name == "tangent") return JacobianMethod::kTangent;
  Refuse(name, "auto, adjoint or tangent");
}

Horizon HorizonFromName(const std::string& name) {
  if (name == "auto") return Horizon::kAuto;
  if (name == "full") return Horizon::kFull;
  if (name == "grow") return Horizon::kGrow;
  if (name == "shooting") return Horizon::kShooting;
  Refuse(name, "auto, full, grow or shooting");
}

UncertaintyMode UncertaintyFromName(const std::string& name) {
  if (name == "auto") return UncertaintyMode::kAuto;
  if (name == "on") return UncertaintyMode::kOn;
  if (name == "off") return UncertaintyMode::kOff;
  Refuse(name, "auto, on or off");
}

Start StartFromName(const std::string& name) {
  if (name == "auto") return {};
  if (name == "inverse_dynamics") return {InitMethod::kInverseDynamics};
  if (name == "scene") return {InitMethod::kScene};
  if (name == "screen") return {InitMethod::kScreen};
  if (name.rfind(kUniform, 0) == 0) return UniformStart(name);
  Refuse(name, "auto, inverse_dynamics, scene, screen or uniform:VALUE");
}

}  // namespace dpe::tools
