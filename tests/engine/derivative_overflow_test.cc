// Derivatives that leave the range of finite numbers are not ok, though the states of
// the rollout are finite; the status says where.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "dpe/engine/sensitivity.h"
#include "dpe/engine/simulator.h"
#include "support/integration_methods.h"
#include "support/test_scenes.h"

namespace dpe::test {
namespace {

// In object 0, where a state depends on the motion up to `frame`.
void ExpectNotFinite(const RolloutStatus& status, int frame) {
  EXPECT_FALSE(status.ok());
  EXPECT_EQ(status.code, RolloutStatus::Code::kNotFinite);
  EXPECT_EQ(status.object, 0);
  EXPECT_EQ(status.frame, frame);
  const std::string start =
      "the derivatives left the range of finite numbers in object 0";
  EXPECT_EQ(status.Message().substr(0, start.size()), start);
}

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
    sensitivity.Gradient({1.5e308 * seed});        // the sum of two frames is infinite
    const int frame = sensitivity.status().frame;  // with two stages: in the step to 4
    EXPECT_TRUE(frame == 3 || (GetParam() == IntegrationMethod::kTrBdf2 && frame == 4));
    ExpectNotFinite(sensitivity.status(), frame);
    // The first failure stays.
    EXPECT_TRUE(sensitivity.Gradient({seed}).allFinite());
    ExpectNotFinite(sensitivity.status(), frame);
  }
  {
    Sensitivity sensitivity(&simulator, &rollout);
    std::vector<Eigen::MatrixXd> dx, dv;
    sensitivity.JacobianVectorProduct(p, &dx, &dv);
    EXPECT_TRUE(sensitivity.ok());
    Eigen::VectorXd large = Eigen::VectorXd::Constant(p.size(), 1.7e308);
    for (int k = 0; k < p.size(); k += 2) large[k] *= -1.0;
    sensitivity.JacobianVectorProduct(large, &dx, &dv);
    ExpectNotFinite(sensitivity.status(), 1);
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
    ExpectNotFinite(sensitivity.status(), 4);
    EXPECT_NE(sensitivity.status().Message().find("residual row 0 by "),
              std::string::npos)
        << sensitivity.status().Message();
  }
}

INSTANTIATE_TEST_SUITE_P(AllMethods, DerivativeOverflowTest, AllIntegrationMethods(),
                         MethodCaseName);

}  // namespace
}  // namespace dpe::test
