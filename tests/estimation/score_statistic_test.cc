#include <gtest/gtest.h>

#include <cmath>

#include "dpe/engine/cloth_builder.h"
#include "estimation/fit_support.h"
#include "score_test.h"
#include "support/test_scenes.h"

namespace dpe {
namespace {

constexpr int kFrames = 30;
constexpr double kSigma = 0.002;  // m

Scene Uniform() {
  Scene scene = test::MakeDerivativeScene("side", 6);
  scene.objects[0].stiffness.setConstant(20.0);
  ApplySettings("nL", &scene);
  return scene;
}

ScoreTest ScoreOf(const Scene& fitted, const Scene& truth, int seed) {
  Observations target = test::OwnMotion(truth, kFrames);
  AddNoise(truth, kSigma, seed, &target);
  StopControl stop(1e9, nullptr);
  return TestScore({{fitted, target, ""}}, EstimatorOptions(), &stop);
}

TEST(ScoreStatisticTest, IsStandardNormalWhereThereIsOnlyNoise) {
  const Scene scene = Uniform();
  constexpr int kRuns = 30;
  double mean = 0.0, square = 0.0;
  for (int seed = 1; seed <= kRuns; ++seed) {
    const ScoreTest test = ScoreOf(scene, scene, seed);
    ASSERT_TRUE(test.ok);
    EXPECT_GT(test.directions, 20);
    mean += test.excess / kRuns;
    square += test.excess * test.excess / kRuns;
  }
  EXPECT_LT(std::abs(mean), 0.6);  // 3 / sqrt(30)
  EXPECT_GT(square, 0.4);
  EXPECT_LT(square, 2.0);
}

TEST(ScoreStatisticTest, SeesWhatVariesOverTheCloth) {
  Scene truth = Uniform();
  MaterialVariation variation;
  variation.stiffness_sigma = 0.1;
  VaryMaterial(variation, &truth.objects[0]);
  const ScoreTest test = ScoreOf(Uniform(), truth, 1);
  EXPECT_TRUE(test.ok);
  EXPECT_GT(test.excess, 10.0);
  EXPECT_FALSE(test.NothingToGain());
}

// What cannot be told is to be fitted.
TEST(ScoreStatisticTest, SaysNothingWhereTheJacobianIsTooLarge) {
  const Scene scene = Uniform();
  EstimatorOptions options;
  options.max_lm_jacobian_bytes = 1.0;
  StopControl stop(1e9, nullptr);
  const ScoreTest test =
      TestScore({{scene, test::OwnMotion(scene, kFrames), ""}}, options, &stop);
  EXPECT_FALSE(test.ok);
  EXPECT_FALSE(test.NothingToGain());
}

}  // namespace
}  // namespace dpe
