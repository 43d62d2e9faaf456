// For tests that every integration method has to pass.
#ifndef DPE_TESTS_SUPPORT_INTEGRATION_METHODS_H_
#define DPE_TESTS_SUPPORT_INTEGRATION_METHODS_H_

#include <gtest/gtest.h>

#include <string>

#include "dpe/engine/scene.h"

namespace dpe::test {

inline auto AllIntegrationMethods() {
  return testing::Values(IntegrationMethod::kExplicitEuler,
                         IntegrationMethod::kSymplecticEuler,
                         IntegrationMethod::kLinearlyImplicitEuler,
                         IntegrationMethod::kImplicitEuler, IntegrationMethod::kTrBdf2);
}

// Names the instances of a suite whose parameter is a method.
inline std::string MethodCaseName(
    const testing::TestParamInfo<IntegrationMethod>& info) {
  return IntegrationMethodName(info.param);
}

}  // namespace dpe::test

#endif  // DPE_TESTS_SUPPORT_INTEGRATION_METHODS_H_
