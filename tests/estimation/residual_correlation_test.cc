#include "residual_correlation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace dpe::test {
namespace {

constexpr int kVertices = 20, kFrames = 200;

class ResidualCorrelationTest : public ::testing::Test {
 protected:
  ResidualCorrelationTest() {
    trajectory_.positions = {Eigen::MatrixXd::Random(3 * kVertices, kFrames)};
  }

  // Errors e_f = phi e_{f-1} + noise: their autocorrelation is phi.
  Eigen::MatrixXd Process(double phi) {
    std::normal_distribution<double> normal;
    Eigen::MatrixXd errors(3 * kVertices, kFrames);
    for (int i = 0; i < errors.rows(); ++i) {
      errors(i, 0) = normal(generator_) / std::sqrt(1.0 - phi * phi);
      for (int f = 1; f < kFrames; ++f) {
        errors(i, f) = phi * errors(i, f - 1) + normal(generator_);
      }
    }
    return 0.01 * errors;
  }

  ResidualCorrelation Correlate() const {
    ResidualCorrelation result;
    CorrelateResiduals(trajectory_, observations_, kFrames, &result);
    return result;
  }

  Trajectory trajectory_;
  Observations observations_;
  std::mt19937 generator_{7};
};

TEST_F(ResidualCorrelationTest, IsThatOfTheProcess) {
  for (const double phi : {0.0, 0.5, 0.95}) {
    observations_.positions = {trajectory_.positions[0] + Process(phi)};
    const ResidualCorrelation result = Correlate();
    EXPECT_EQ(result.num_pairs, 3L * kVertices * (kFrames - 1));
    EXPECT_NEAR(result.rho(), phi, 5.0 / std::sqrt(result.num_pairs)) << phi;
  }
}

TEST_F(ResidualCorrelationTest, PairsNeedBothFrames) {
  Eigen::MatrixXd errors = Process(0.5);
  // Every third frame is missing: one pair is left of three.
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int f = 2; f < kFrames; f += 3) errors.col(f).setConstant(nan);
  observations_.positions = {trajectory_.positions[0] + errors};
  const ResidualCorrelation result = Correlate();
  EXPECT_EQ(result.num_pairs, 3L * kVertices * 67);
  EXPECT_NEAR(result.rho(), 0.5, 5.0 / std::sqrt(result.num_pairs));
}

// Samples of one marker, in whatever order, against the next of the same marker.
TEST_F(ResidualCorrelationTest, Markers) {
  const Eigen::MatrixXd errors = Process(0.8);
  observations_.markers.resize(kVertices);
  for (int v = 0; v < kVertices; ++v) {
    observations_.markers[v].vertices = {v};
    observations_.markers[v].weights = {1.0};
  }
  for (int f = kFrames - 1; f >= 0; --f) {
    for (int v = 0; v < kVertices; ++v) {
      MarkerSample sample;
      sample.marker = v;
      sample.time = f;
      sample.position = trajectory_.positions[0].col(f).segment<3>(3 * v) +
                        errors.col(f).segment<3>(3 * v);
      observations_.samples.push_back(sample);
    }
  }
  const ResidualCorrelation result = Correlate();
  EXPECT_EQ(result.num_pairs, 3L * kVertices * (kFrames - 1));
  EXPECT_NEAR(result.rho(), 0.8, 5.0 / std::sqrt(result.num_pairs));
}

TEST_F(ResidualCorrelationTest, NothingObservedIsNoPair) {
  const ResidualCorrelation result = Correlate();
  EXPECT_EQ(result.num_pairs, 0);
  EXPECT_EQ(result.rho(), 0.0);
}

}  // namespace
}  // namespace dpe::test
