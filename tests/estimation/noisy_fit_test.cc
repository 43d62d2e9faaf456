// Whole fits to what a capture is like: noise, outliers, gaps, few vertices.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "dpe/estimation/estimator.h"
#include "estimation/fit_support.h"
#include "support/test_scenes.h"

namespace dpe {
namespace {

constexpr int kFrames = 60;
constexpr int kSeeds = 5;
constexpr double kSigma = 0.005;  // m

// Stiffness per kind of spring and damping, of which the scene is an exact instance.
Scene GroupedScene(const std::string& preset) {
  Scene scene = test::MakeDerivativeScene(preset, 7);
  ApplySettings("nR", &scene);
  scene.objects[0].estimate_damping = true;
  const ParameterLayout layout(scene);
  layout.Insert(layout.Extract(scene), &scene);
  return scene;
}

// Every second vertex, with noise; `outliers` of the positions are 10 cm off, `missing`
// of them are not there (fractions).
Observations Capture(const Scene& scene, int seed, double outliers, double missing) {
  Observations capture = test::OwnMotion(scene, kFrames);
  AddNoise(scene, kSigma, seed, &capture);
  capture.sigma = kSigma;
  std::mt19937_64 generator(1000 + seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::normal_distribution<double> normal;
  for (int f = 1; f < kFrames; ++f) {
    for (int v = 0; v < scene.objects[0].num_vertices(); ++v) {
      auto position = capture.positions[0].col(f).segment<3>(3 * v);
      Eigen::Vector3d direction(normal(generator), normal(generator),
                                normal(generator));
      const double draw = uniform(generator);
      if (v % 2 == 1 || draw < missing) {
        position.setConstant(std::numeric_limits<double>::quiet_NaN());
      } else if (draw < missing + outliers) {
        position += 0.1 * direction.normalized();
      }
    }
  }
  return capture;
}

// Errors of the coordinates over their reported deviations.
Eigen::VectorXd ScaledErrors(const EstimatorSummary& summary, const Scene& truth) {
  const ParameterLayout layout(truth);
  const Eigen::VectorXd deviations =
      summary.uncertainty.covariance.diagonal().cwiseSqrt();
  const Eigen::VectorXd values = layout.Extract(truth);
  return ((summary.parameters.array() / values.array()).log() / deviations.array())
      .matrix();
}

struct Outcome {
  double rms_relative_error = 0.0;
  double largest_scaled_error = 0.0;
};

Outcome FitAll(const Scene& scene, LossType loss, double outliers, double missing) {
  Outcome outcome;
  const ParameterLayout layout(scene);
  const Eigen::VectorXd truth = layout.Extract(scene);
  for (int seed = 1; seed <= kSeeds; ++seed) {
    EstimatorOptions options;
    options.loss = loss;
    const EstimatorSummary summary =
        Estimate(scene, Capture(scene, seed, outliers, missing), options);
    EXPECT_TRUE(summary.usable()) << summary.message;
    EXPECT_TRUE(summary.uncertainty.ok) << summary.uncertainty.message;
    if (!summary.uncertainty.ok) continue;
    outcome.rms_relative_error +=
        (summary.parameters.array() / truth.array()).log().square().mean() / kSeeds;
    outcome.largest_scaled_error =
        std::max(outcome.largest_scaled_error,
                 ScaledErrors(summary, scene).cwiseAbs().maxCoeff());
  }
  outcome.rms_relative_error = std::sqrt(outcome.rms_relative_error);
  return outcome;
}

TEST(NoisyFitTest, ErrorsAreWithinTheReportedDeviations) {
  for (const char* preset : {"side", "flag"}) {
    const Scene scene = GroupedScene(preset);
    const Outcome clean = FitAll(scene, LossType::kNone, 0.0, 0.0);
    // 20 numbers; more than 3.5 deviations has a chance of 1 %.
    EXPECT_LT(clean.largest_scaled_error, 3.5) << preset;
    EXPECT_GT(clean.largest_scaled_error, 0.5) << preset;
    EXPECT_LT(clean.rms_relative_error, 0.2) << preset;
    EXPECT_LT(FitAll(scene, LossType::kNone, 0.0, 0.3).largest_scaled_error, 3.5);
  }
}

// With three unknowns the start is a screen's; over all frames at once it is so far off
// that a robust loss takes nearly everything for outliers.
TEST(NoisyFitTest, ARobustFitGrowsItsHorizonWithAnyNumberOfParameters) {
  Scene scene = GroupedScene("flag");
  scene.objects[0].estimate_damping = false;
  EstimatorOptions options;
  options.loss = LossType::kCauchy;
  const EstimatorSummary summary =
      Estimate(scene, Capture(scene, 1, 0.05, 0.0), options);
  EXPECT_TRUE(summary.usable()) << summary.message;
  EXPECT_FALSE(summary.horizons.empty());
  EXPECT_LT(ScaledErrors(summary, scene).cwiseAbs().maxCoeff(), 3.5);
}

TEST(NoisyFitTest, ACauchyLossKeepsGrossOutliersOut) {
  const Scene scene = GroupedScene("side");
  const Outcome clean = FitAll(scene, LossType::kNone, 0.0, 0.0);
  const Outcome robust = FitAll(scene, LossType::kCauchy, 0.05, 0.0);
  const Outcome plain = FitAll(scene, LossType::kNone, 0.05, 0.0);
  EXPECT_LT(robust.rms_relative_error, 2.0 * clean.rms_relative_error);
  EXPECT_GT(plain.rms_relative_error, 1.5 * robust.rms_relative_error);
}

}  // namespace
}  // namespace dpe
