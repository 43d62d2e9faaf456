#include "relative_step_manifold.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

namespace dpe::test {
namespace {

using Eigen::VectorXd;

VectorXd Plus(const VectorXd& x, const VectorXd& delta) {
  VectorXd y(x.size());
  EXPECT_TRUE(RelativeStepManifold(static_cast<int>(x.size()))
                  .Plus(x.data(), delta.data(), y.data()));
  return y;
}

// A step of any length leaves the quantity positive and finite; one that does not halve
// it changes it in proportion.
TEST(RelativeStepManifoldTest, StepsAreRelativeChanges) {
  const VectorXd x = VectorXd::Constant(6, std::log(40.0));
  VectorXd delta(6);
  delta << 0.0, 0.25, 9.0, -0.25, -0.5, -1e6;
  const VectorXd p = Plus(x, delta).array().exp();
  EXPECT_DOUBLE_EQ(p[0], 40.0);
  EXPECT_NEAR(p[1], 50.0, 1e-12);
  EXPECT_NEAR(p[2], 400.0, 1e-11);
  EXPECT_NEAR(p[3], 30.0, 1e-12);
  EXPECT_NEAR(p[4], 20.0, 1e-12);
  EXPECT_GT(p[5], 0.0);
}

TEST(RelativeStepManifoldTest, MinusUndoesPlus) {
  const VectorXd x = VectorXd::LinSpaced(41, -3.0, 7.0);
  const VectorXd delta = VectorXd::LinSpaced(41, -4.0, 4.0);
  const VectorXd y = Plus(x, delta);
  VectorXd back(41);
  ASSERT_TRUE(RelativeStepManifold(41).Minus(y.data(), x.data(), back.data()));
  EXPECT_LT((back - delta).lpNorm<Eigen::Infinity>(), 1e-13);
}

// The slope is continuous, also where the two branches meet, and 1 at no step: the
// Jacobians of the coordinates serve as they are.
TEST(RelativeStepManifoldTest, SlopesAgreeWithDifferences) {
  constexpr double kStep = 1e-6;
  for (const double d : {-3.0, -0.5, -0.2, 0.0, 0.5, 5.0}) {
    const VectorXd x = VectorXd::Zero(2);
    VectorXd ends(2);
    ends << d + kStep, d - kStep;
    const VectorXd y = Plus(x, ends);
    const double slope = d >= -0.5 ? 1.0 / (1.0 + d) : 2.0 / (-2.0 * d);
    EXPECT_NEAR((y[0] - y[1]) / (2 * kStep), slope, 1e-5 * slope) << d;
  }
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> plus, minus;
  const VectorXd x = VectorXd::Constant(3, 2.0);
  ASSERT_TRUE(RelativeStepManifold(3).PlusJacobian(x.data(), plus.data()));
  ASSERT_TRUE(RelativeStepManifold(3).MinusJacobian(x.data(), minus.data()));
  EXPECT_TRUE(plus.isIdentity(0.0));
  EXPECT_TRUE(minus.isIdentity(0.0));
}

}  // namespace
}  // namespace dpe::test
