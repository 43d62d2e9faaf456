// What estimator options are called in flags and in campaigns. All throw SceneError
// with the value and what is accepted; the caller names the flag.
#ifndef DPE_TOOLS_SUPPORT_ESTIMATOR_NAMES_H_
#define DPE_TOOLS_SUPPORT_ESTIMATOR_NAMES_H_

#include <string>

#include "dpe/engine/sensitivity.h"
#include "dpe/estimation/estimator.h"

namespace dpe::tools {

SolverType SolverFromName(const std::string& name);
JacobianMethod JacobianFromName(const std::string& name);
Horizon HorizonFromName(const std::string& name);
UncertaintyMode UncertaintyFromName(const std::string& name);

struct Start {
  InitMethod method = InitMethod::kAuto;
  double uniform_value = 1.0;
};
// auto, inverse_dynamics, scene, screen, uniform:VALUE
Start StartFromName(const std::string& name);

}  // namespace dpe::tools

#endif  // DPE_TOOLS_SUPPORT_ESTIMATOR_NAMES_H_
