// Derivatives that leave the range of finite numbers are not ok, though the states of
// the rollout are finite.
#include <gtest/gtest.h>

#include <vector>

#include "dpe/engine/sensitivity.h"
#include "dpe/engine/simulator.h"
#include "support/integration_methods.h"
#include "support/test_scenes.h"

namespace dpe::test {
namespace {

class DerivativeOverflowTest : public testing::TestWithParam<IntegrationMethod> {};

TEST_P(DerivativeOverflowTest, IsNotOk) {
  Scene scene = MakeDerivativeScene("side", 4);
  scene.integration_method = GetParam();
  scene.delta = 0.002;
  EstimateEverything(ParameterMode::kGlobal, &scene);
  Simulator simulator(scene);
  const Eigen::VectorXd p = simulator.layout().Extract(scene);
  const Rollout rollout = simulator.Run(p, 5);
  ASSERT_TRUE(rollout.status().ok());
  Eigen::MatrixXd seed = Eigen::MatrixXd::Ones(48, 5);
  {
    Sensitivity sensitivity(&simulator, &rollout);
    EXPECT_TRUE(sensitivity.Gradient({seed}).allFinite());
    EXPECT_TRUE(sensitivity.ok());
    sensitivity.Gradient({1.5e308 * seed});  // the sum of two frames is infinite
    EXPECT_FALSE(sensitivity.ok());
  }
  {
    Sensitivity sensitivity(&simulator, &rollout);
    std::vector<Eigen::MatrixXd> dx, dv;
    sensitivity.JacobianVectorProduct(p, &dx, &dv);
    EXPECT_TRUE(sensitivity.ok());
    Eigen::VectorXd large = Eigen::VectorXd::Constant(p.size(), 1.7e308);
    for (int k = 0; k < p.size(); k += 2) large[k] *= -1.0;
    sensitivity.JacobianVectorProduct(large, &dx, &dv);
    EXPECT_FALSE(sensitivity.ok());
  }
  for (auto jacobian_method : {JacobianMethod::kTangent, JacobianMethod::kAdjoint}) {
    Sensitivity sensitivity(&simulator, &rollout);
    StateDerivative derivative;
    derivative.frame = 4;
    derivative.d_position.resize(1, 48);
    for (int k = 0; k < 48; ++k) derivative.d_position.insert(0, k) = 1.0;
    sensitivity.Jacobian({derivative}, 1, jacobian_method);
    EXPECT_TRUE(sensitivity.ok());
    derivative.d_position *= 1.7e308;
    StateDerivative earlier = derivative;
    earlier.frame = 3;
    sensitivity.Jacobian({earlier, derivative}, 1, jacobian_method);
    EXPECT_FALSE(sensitivity.ok());
  }
}

INSTANTIATE_TEST_SUITE_P(AllMethods, DerivativeOverflowTest, AllIntegrationMethods(),
                         MethodCaseName);

}  // namespace
}  // namespace dpe::test
