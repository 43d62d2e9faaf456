#include "dpe/estimation/robust_loss.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dpe/engine/scene.h"
#include "support/derivative_checker.h"
#include "support/test_scenes.h"

namespace dpe {
namespace {

constexpr LossType kLosses[] = {LossType::kNone, LossType::kHuber, LossType::kCauchy,
                                LossType::kTukey};

TEST(RobustLossTest, ResidualSquaredIsRhoAndItsDerivativeAgreesWithDifferences) {
  for (const LossType type : kLosses) {
    const RobustLoss loss(type, 1.7);
    for (const double size : {1e-9, 0.3, 1.6, 1.8, 40.0}) {
      const Eigen::Vector3d r = size * test::RandomVector(3, 1).normalized();
      Eigen::Vector3d bent = r;
      const Eigen::Matrix3d derivative = loss.Apply(bent);
      EXPECT_NEAR(bent.squaredNorm(), loss.Rho(r.squaredNorm()),
                  1e-14 * bent.squaredNorm());
      const Eigen::VectorXd direction = size * test::RandomVector(3, 2);
      const auto check = test::CheckDirectionalDerivative(
          [&](const Eigen::VectorXd& x) {
            Eigen::Vector3d value = x;
            loss.Apply(value);
            return Eigen::VectorXd(value);
          },
          r, direction, derivative * direction);
      EXPECT_LT(check.relative_error, 1e-8) << LossTypeName(type) << size << check;
    }
  }
}

TEST(RobustLossTest, SmallResidualsCountInFullAndLargeOnesLess) {
  for (const LossType type : kLosses) {
    const RobustLoss loss(type, 2.0);
    EXPECT_NEAR(loss.Rho(1e-30) / 1e-30, 1.0, 1e-12) << LossTypeName(type);
    EXPECT_EQ(loss.Derivative(0.0), 1.0);
    double before = 1.0;
    for (double s = 1.0; s < 1e4; s *= 3.0) {
      EXPECT_LE(loss.Derivative(s), before);
      before = loss.Derivative(s);
    }
    EXPECT_EQ(type == LossType::kNone, before == 1.0);
  }
  EXPECT_EQ(RobustLoss(LossType::kTukey, 2.0).Derivative(5.0), 0.0);
}

// The asymptotic variance of a location estimate in three dimensions, by quadrature.
double Efficiency(const RobustLoss& loss) {
  const int n = 40000;
  const double step = 12.0 / n;
  double mass = 0.0, slope = 0.0, square = 0.0;
  const auto psi = [&](double u) { return loss.Derivative(u * u) * u; };
  for (int i = 0; i < n; ++i) {
    const double u = (i + 0.5) * step;
    const double density = u * u * std::exp(-0.5 * u * u);
    const double dpsi = (psi(u + 1e-5) - psi(u - 1e-5)) / 2e-5;
    mass += density;
    slope += density * (dpsi / 3.0 + 2.0 / 3.0 * psi(u) / u);
    square += density * psi(u) * psi(u);
  }
  slope /= mass;
  square /= mass;
  return slope * slope / (square / 3.0);
}

TEST(RobustLossTest, DefaultScalesKeep95PercentOfTheEfficiency) {
  for (const LossType type : kLosses) {
    const double expected = type == LossType::kNone ? 1.0 : 0.95;
    EXPECT_NEAR(Efficiency(RobustLoss(type, RobustLoss::DefaultScale(type))), expected,
                1e-4)
        << LossTypeName(type);
  }
}

TEST(RobustLossTest, NamesRoundTripAndOthersAreRefused) {
  for (const LossType type : kLosses) {
    EXPECT_EQ(LossTypeFromName(LossTypeName(type)), type);
  }
  try {
    LossTypeFromName("welsch");
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("\"welsch\""));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("huber, cauchy, tukey"));
  }
}

}  // namespace
}  // namespace dpe
