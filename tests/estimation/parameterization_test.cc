#include "dpe/estimation/parameterization.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/derivative_checker.h"
#include "support/test_scenes.h"

namespace dpe {
namespace {

ParameterLayout LayoutOfEverything() {
  Scene scene = test::MakeDerivativeScene("two_objects", 4);
  test::EstimateEverything(ParameterMode::kLocal, &scene);
  return ParameterLayout(scene);
}

TEST(ParameterMapTest, PositiveKindsAreLogarithmicAndTheOthersPlain) {
  const ParameterLayout layout = LayoutOfEverything();
  const ParameterMap map(layout);
  bool seen_log = false, seen_plain = false;
  for (const ParameterBlock& block : layout.blocks()) {
    const bool positive = block.kind != ParameterKind::kWind &&
                          block.kind != ParameterKind::kInitialVelocity &&
                          block.kind != ParameterKind::kInitialPosition;
    EXPECT_EQ(map.is_log(block.offset), positive) << ParameterKindName(block.kind);
    seen_log = seen_log || positive;
    seen_plain = seen_plain || !positive;
  }
  EXPECT_TRUE(seen_log && seen_plain);
}

TEST(ParameterMapTest, CoordinatesMapBackToTheSameParameters) {
  const ParameterLayout layout = LayoutOfEverything();
  const ParameterMap map(layout);
  Eigen::VectorXd parameters = test::RandomVector(layout.size(), 3);
  for (int i = 0; i < layout.size(); ++i) {
    if (map.is_log(i)) parameters[i] = std::exp(5.0 * parameters[i]);
  }
  int num_raised = -1;
  const Eigen::VectorXd back =
      map.ToParameters(map.ToCoordinates(parameters, &num_raised));
  EXPECT_LT(((back - parameters).array() / parameters.array()).abs().maxCoeff(), 1e-14);
  EXPECT_EQ(num_raised, 0);
}

TEST(ParameterMapTest, DerivativeAgreesWithDifferences) {
  const ParameterLayout layout = LayoutOfEverything();
  const ParameterMap map(layout);
  const Eigen::VectorXd q = test::RandomVector(layout.size(), 4);
  const Eigen::VectorXd direction = test::RandomVector(layout.size(), 5);
  const auto check = test::CheckDirectionalDerivative(
      [&](const Eigen::VectorXd& x) { return map.ToParameters(x); }, q, direction,
      map.Derivative(q).cwiseProduct(direction));
  EXPECT_LT(check.relative_error, 1e-10) << check;
  EXPECT_GT(check.norm, 0.0);
}

TEST(ParameterMapTest, StartsThatAreNotPositiveAreRaisedAndCounted) {
  Scene scene = test::MakeDerivativeScene("side", 3);
  ApplySettings("nL", &scene);
  const ParameterLayout layout(scene);
  const ParameterMap map(layout);
  Eigen::VectorXd parameters = Eigen::VectorXd::Constant(layout.size(), 2.0);
  parameters[0] = 0.0;
  parameters[1] = -3.0;
  parameters[2] = std::numeric_limits<double>::quiet_NaN();
  int num_raised = 0;
  const Eigen::VectorXd back =
      map.ToParameters(map.ToCoordinates(parameters, &num_raised));
  EXPECT_EQ(num_raised, 3);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(back[i] / ParameterMap::kFloor, 1.0, 1e-12);
  EXPECT_NEAR(back[3], 2.0, 1e-15);
}

TEST(ParameterMapTest, UnderflowStaysPositive) {
  Scene scene = test::MakeDerivativeScene("side", 3);
  ApplySettings("Gn", &scene);
  const ParameterMap map{ParameterLayout(scene)};
  EXPECT_GT(map.ToParameters(Eigen::VectorXd::Constant(1, -1e4))[0], 0.0);
}

}  // namespace
}  // namespace dpe
