#include <gtest/gtest.h>

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
