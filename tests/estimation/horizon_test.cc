#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "dpe/estimation/estimator.h"
#include "estimation/fit_support.h"
#include "support/test_scenes.h"

namespace dpe {
namespace {

constexpr int kFrames = 60;

EstimatorOptions FromUniformStart(Horizon horizon) {
  EstimatorOptions options;
  options.init = InitMethod::kUniform;
  options.uniform_value = 10.0;
  options.horizon = horizon;
  return options;
}

Scene FlagWithLocalStiffness() {
  Scene scene = test::MakeDerivativeScene("flag", 5);
  test::Perturb(2, &scene);
  ApplySettings("nL", &scene);
  return scene;
}

// The case that the growing horizon is for: the same start over all frames at once ends
// far away, or cannot even be simulated.
TEST(HorizonTest, GrowingFindsWhatAllFramesAtOnceDoNot) {
  const Scene scene = FlagWithLocalStiffness();
  const Observations target = test::OwnMotion(scene, kFrames);
  const EstimatorSummary grown =
      Estimate(scene, target, FromUniformStart(Horizon::kAuto));
  EXPECT_EQ(grown.termination, Termination::kConverged) << grown.message;
  EXPECT_LT(grown.final_rms, 1e-10);
  EXPECT_LT(ParameterDeviationPercent(grown, scene), 1e-4);
  ASSERT_GE(grown.horizons.size(), 3u);
  for (size_t i = 1; i < grown.horizons.size(); ++i) {
    EXPECT_GT(grown.horizons[i].num_frames, grown.horizons[i - 1].num_frames);
    EXPECT_LE(grown.horizons[i].final_rms, grown.horizons[i].start_rms);
  }
  EXPECT_LT(grown.horizons.back().num_frames, kFrames);
  const EstimatorSummary full =
      Estimate(scene, target, FromUniformStart(Horizon::kFull));
  EXPECT_TRUE(full.horizons.empty());
  EXPECT_FALSE(full.final_rms < 1e3 * grown.final_rms);  // also if there is none
}

// Few frames hold all that is to be known of springs that hardly move the motion in so
// short a time. With steps that are changes of logarithms this takes more than 200
// iterations.
TEST(HorizonTest, StiffnessesThatMakeUpForEachOtherAreFoundInFewIterations) {
  Scene scene = test::MakeDerivativeScene("flag", 7);
  ApplySettings("nL", &scene);
  const EstimatorSummary summary =
      Estimate(scene, test::OwnMotion(scene, 20), FromUniformStart(Horizon::kAuto));
  EXPECT_EQ(summary.termination, Termination::kConverged) << summary.message;
  EXPECT_LT(summary.final_rms, 1e-11);
  EXPECT_LT(ParameterDeviationPercent(summary, scene), 1e-3);
  EXPECT_LT(summary.iterations, 60);
}

// Every element is off by the same factor of 1e5: hundreds of unknowns that are damped
// together do not get there, one for all of them does at once.
class FarUniformStartTest : public ::testing::TestWithParam<const char*> {};

TEST_P(FarUniformStartTest, IsLeftByOneValueForAllElements) {
  Scene scene = test::MakeDerivativeScene("flag", 6);
  ApplySettings(GetParam(), &scene);
  EstimatorOptions options = FromUniformStart(Horizon::kAuto);
  options.uniform_value = 1e-4;
  const EstimatorSummary summary = Estimate(scene, test::OwnMotion(scene, 20), options);
  EXPECT_EQ(summary.termination, Termination::kConverged) << summary.message;
  EXPECT_LT(summary.final_rms, 1e-10);
  EXPECT_LT(ParameterDeviationPercent(summary, scene), 1e-3);
  EXPECT_TRUE(test::HasNote(summary, "one value for all of them was fitted first"));
}

INSTANTIATE_TEST_SUITE_P(Settings, FarUniformStartTest,
                         ::testing::Values("Ln", "nL", "LL"),
                         [](const auto& info) { return std::string(info.param); });

// A start that says something of each element is kept.
TEST(HorizonTest, ElementsThatDifferAreNotMadeAlike) {
  const Scene scene = FlagWithLocalStiffness();
  EstimatorOptions options = FromUniformStart(Horizon::kGrow);
  options.init_perturbation = 0.1;
  const EstimatorSummary summary =
      Estimate(scene, test::OwnMotion(scene, kFrames), options);
  EXPECT_FALSE(test::HasNote(summary, "one value for all"));
}

// What the first frames do not determine a fit to them changes by any factor to follow
// their noise; from there the way back is long, or there is none.
TEST(HorizonTest, NoiseOfTheFirstFramesDoesNotLeadAway) {
  constexpr double kSigma = 0.005;
  Scene scene = test::MakeDerivativeScene("corners", 6);
  ApplySettings("nR", &scene);
  scene.objects[0].estimate_damping = true;
  Eigen::VectorXd truth(4);
  truth << 45.0, 25.0, 6.0, 0.1;
  ParameterLayout(scene).Insert(truth, &scene);
  const Observations motion = test::OwnMotion(scene, kFrames);
  for (unsigned seed = 0; seed < 8; ++seed) {
    Observations seen = motion;
    seen.sigma = kSigma;
    AddNoise(scene, kSigma, seed, &seen);
    for (int v = 0; v < scene.objects[0].num_vertices(); ++v) {
      if (v % 4 != 0) seen.positions[0].middleRows(3 * v, 3).setConstant(std::nan(""));
    }
    EstimatorOptions options;
    options.init = InitMethod::kScene;
    options.init_perturbation = 0.3;
    options.seed = seed;
    const EstimatorSummary summary = Estimate(scene, seen, options);
    EXPECT_LT(summary.final_rms, 1.1 * std::sqrt(3.0) * kSigma) << seed;
  }
}

// Where the first frames were not seen, windows in the middle of the motion are fitted.
TEST(HorizonTest, ShootingStartsFromWindows) {
  Scene scene = test::MakeDerivativeScene("side", 4);
  ApplySettings("nR", &scene);
  const ParameterLayout layout(scene);
  layout.Insert(layout.Extract(scene), &scene);
  const Observations target = test::OwnMotion(scene, 40);
  EstimatorOptions options = FromUniformStart(Horizon::kShooting);
  int num_reports = 0;
  options.progress = [&](const IterationReport&) { ++num_reports; };
  const EstimatorSummary summary = Estimate(scene, target, options);
  EXPECT_EQ(summary.termination, Termination::kConverged) << summary.message;
  EXPECT_LT(summary.final_rms, 1e-10);
  EXPECT_GT(num_reports, 1);
  bool is_told = false;
  for (const std::string& note : summary.notes) {
    is_told |= note.find("windows of 10 frames") != std::string::npos;
  }
  EXPECT_TRUE(is_told);
  const std::vector<CapturedMotion> two = {{scene, target, "a"}, {scene, target, "b"}};
  EXPECT_THROW(Estimate(two, options), SceneError);
}

// A capture that begins in the middle of the motion.
TEST(HorizonTest, GrowsFromTheFirstFrameThatWasSeen) {
  const Scene scene = FlagWithLocalStiffness();
  Observations target = test::OwnMotion(scene, kFrames);
  target.positions[0].leftCols(3).setConstant(std::nan(""));
  const EstimatorSummary summary =
      Estimate(scene, target, FromUniformStart(Horizon::kGrow));
  ASSERT_FALSE(summary.horizons.empty());
  EXPECT_EQ(summary.horizons[0].num_frames, 3 + 5);
  EXPECT_LT(summary.final_rms, 1e-10);
}

TEST(HorizonTest, FewFramesNeedNoGrowing) {
  const Scene scene = FlagWithLocalStiffness();
  const Observations target = test::OwnMotion(scene, 6);
  const EstimatorSummary summary =
      Estimate(scene, target, FromUniformStart(Horizon::kGrow));
  EXPECT_TRUE(summary.horizons.empty());
  EXPECT_LT(summary.final_rms, summary.initial_rms);
}

}  // namespace
}  // namespace dpe
