#include "forecast_weight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dpe {
namespace {

constexpr int kFrames = 33;
constexpr int kRows = 90;

using Residuals = std::vector<Eigen::VectorXd>;

double SquaredNorm(const Residuals& residuals) {
  double sum = 0.0;
  for (const Eigen::VectorXd& r : residuals) sum += r.squaredNorm();
  return sum;
}

// Noise of variance 1; `memory` of it is that of the frame before.
Residuals Noise(std::mt19937* generator, double memory = 0.0) {
  std::normal_distribution<double> normal;
  Residuals noise;
  for (int f = 0; f < kFrames; ++f) {
    noise.emplace_back(kRows);
    for (double& value : noise.back()) value = normal(*generator);
    if (f > 0) {
      noise[f] = memory * noise[f - 1] + std::sqrt(1.0 - memory * memory) * noise[f];
    }
  }
  return noise;
}

// An error of a model that grows with time, in a fixed direction.
Residuals Sum(const Residuals& noise, double error) {
  Residuals sum = noise;
  for (int f = 0; f < kFrames; ++f) {
    for (int i = 0; i < kRows; ++i) sum[f][i] += error * std::sin(i) * f / kFrames;
  }
  return sum;
}

TEST(ForecastWeightTest, IsTheBestMixtureAndSaysWhichIsBetter) {
  std::mt19937 generator(1);
  const Residuals a = Noise(&generator), b = Sum(Noise(&generator), 0.3);
  const ForecastWeight forward = WeighForecasts(a, b);
  const ForecastWeight back = WeighForecasts(b, a);
  EXPECT_NEAR(forward.weight + back.weight, 1.0, 1e-12);
  EXPECT_NEAR(forward.deviation, back.deviation, 1e-12);
  const auto mixed = [&](double weight) {
    Residuals sum = a;
    for (int f = 0; f < kFrames; ++f) sum[f] += weight * (b[f] - a[f]);
    return SquaredNorm(sum);
  };
  EXPECT_LT(mixed(forward.weight), mixed(forward.weight + 0.01));
  EXPECT_LT(mixed(forward.weight), mixed(forward.weight - 0.01));
  Residuals difference = a;
  for (int f = 0; f < kFrames; ++f) difference[f] -= b[f];
  EXPECT_NEAR(SquaredNorm(a) - SquaredNorm(b),
              2.0 * (forward.weight - 0.5) * SquaredNorm(difference), 1e-9);
}

// A model without error against one whose error grows: certain without noise, and in
// any unit.
TEST(ForecastWeightTest, AnErrorThatGrowsIsNoScatter) {
  Residuals right, wrong;
  for (int f = 0; f < kFrames; ++f) right.push_back(Eigen::VectorXd::Zero(kRows));
  for (const double unit : {1e-9, 1.0, 1e9}) {
    wrong = Sum(right, unit);
    const ForecastWeight weight = WeighForecasts(wrong, right);
    EXPECT_NEAR(weight.weight, 1.0, 1e-12);
    EXPECT_LT(weight.deviation, 1e-12);
    EXPECT_TRUE(weight.RicherIsBetter());
    EXPECT_FALSE(WeighForecasts(right, wrong).RicherIsBetter());
  }
  EXPECT_FALSE(WeighForecasts(right, right).RicherIsBetter());
  EXPECT_EQ(WeighForecasts(right, right).weight, 0.0);
}

// The deviation is that of the weight over many noises, whether neighbouring frames
// share the noise or not.
TEST(ForecastWeightTest, DeviationIsHonest) {
  for (const double memory : {0.0, 0.6}) {
    std::mt19937 generator(2);
    constexpr int kRuns = 400;
    double sum_of_squares = 0.0, sum_of_variances = 0.0, mean = 0.0;
    int beyond_two = 0;
    for (int run = 0; run < kRuns; ++run) {
      const Residuals noise = Noise(&generator, memory);
      const ForecastWeight weight = WeighForecasts(Sum(noise, 0.3), Sum(noise, -0.3));
      const double error = weight.weight - 0.5;  // both are as wrong
      mean += error / kRuns;
      sum_of_squares += error * error / kRuns;
      sum_of_variances += weight.deviation * weight.deviation / kRuns;
      if (weight.RicherIsBetter()) ++beyond_two;
    }
    const double spread = std::sqrt(sum_of_squares);
    EXPECT_LT(std::abs(mean), 0.2 * spread);
    const double ratio = std::sqrt(sum_of_variances) / spread;
    // Blocks are too short for all that a memory of several frames does; without them
    // it would be 0.5.
    EXPECT_GT(ratio, memory == 0.0 ? 0.95 : 0.7) << memory;
    EXPECT_LT(ratio, 1.3) << memory;
    EXPECT_LT(beyond_two, kRuns * (memory == 0.0 ? 0.06 : 0.12)) << memory;
  }
}

}  // namespace
}  // namespace dpe
