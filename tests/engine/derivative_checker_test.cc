#include "support/derivative_checker.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dpe::test {
namespace {

Eigen::VectorXd Spiral(const Eigen::VectorXd& x) {
  return Eigen::Vector3d(std::sin(x[0]) * x[1], std::exp(0.3 * x[0] * x[1]),
                         x[1] * x[1]);
}

Eigen::MatrixXd SpiralJacobian(const Eigen::VectorXd& x) {
  Eigen::MatrixXd j(3, 2);
  const double e = 0.3 * std::exp(0.3 * x[0] * x[1]);
  j << std::cos(x[0]) * x[1], std::sin(x[0]), e * x[1], e * x[0], 0.0, 2.0 * x[1];
  return j;
}

TEST(DerivativeCheckerTest, AcceptsAnExactDerivative) {
  const Eigen::Vector2d x(0.7, -1.3);
  EXPECT_LT(CheckJacobian(Spiral, x, SpiralJacobian(x)).relative_error, 1e-9);
}

TEST(DerivativeCheckerTest, RejectsAPoisonedDerivative) {
  const Eigen::Vector2d x(0.7, -1.3);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 2; ++column) {
      Eigen::MatrixXd poisoned = SpiralJacobian(x);
      poisoned(row, column) += 1e-4;
      EXPECT_GT(CheckJacobian(Spiral, x, poisoned).relative_error, 1e-5)
          << row << "," << column;
    }
  }
}

TEST(DerivativeCheckerTest, RejectsAWrongScaleAndAMissingDerivative) {
  const Eigen::Vector2d x(0.7, -1.3);
  EXPECT_GT(CheckJacobian(Spiral, x, 1.001 * SpiralJacobian(x)).relative_error, 9e-4);
  EXPECT_NEAR(CheckJacobian(Spiral, x, Eigen::MatrixXd::Zero(3, 2)).relative_error, 1.0,
              1e-6);
}

TEST(DerivativeCheckerTest, RejectsAOneSidedDerivativeAtAKink) {
  const auto kink = [](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return x.cwiseAbs();
  };
  const Eigen::VectorXd at_kink = Eigen::VectorXd::Zero(1);
  EXPECT_GT(CheckJacobian(kink, at_kink, Eigen::MatrixXd::Ones(1, 1)).relative_error,
            0.5);
}

TEST(DerivativeCheckerTest, RandomVectorsRepeat) {
  EXPECT_EQ(RandomVector(5, 3), RandomVector(5, 3));
  EXPECT_NE(RandomVector(5, 3), RandomVector(5, 4));
}

}  // namespace
}  // namespace dpe::test
