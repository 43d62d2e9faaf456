// Fields of stiffness from few, noisy markers, with and without a smoothness prior.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "dpe/engine/cloth_builder.h"
#include "dpe/estimation/checkpoint.h"
#include "dpe/estimation/estimator.h"
#include "dpe/estimation/joint_layout.h"
#include "estimation/fit_support.h"
#include "support/temp_dir.h"

namespace dpe {
namespace {

using ::testing::HasSubstr;

constexpr int kFrames = 40;
constexpr double kSigma = 0.002;  // m

// 7 x 7 vertices, half of them seen, stiffnesses that vary smoothly by a factor of
// about 1.6.
class SmoothnessFitTest : public ::testing::Test {
 protected:
  SmoothnessFitTest() {
    PresetOptions preset;
    preset.rows = preset.cols = 7;
    scene_ = MakePresetScene(ScenePreset::kSide, preset);
    MaterialVariation variation;
    variation.stiffness_sigma = 0.5;
    variation.wave_length = 7.0;
    variation.seed = 5;
    VaryMaterial(variation, &scene_.objects[0]);
    ApplySettings("nL", &scene_);
    truth_ = ParameterLayout(scene_).Extract(scene_);
    target_ = test::OwnMotion(scene_, kFrames);
    AddNoise(scene_, kSigma, 11, &target_);
    for (int v = 1; v < scene_.objects[0].num_vertices(); v += 2) {
      target_.positions[0].middleRows(3 * v, 3).setConstant(std::nan(""));
    }
    target_.sigma = kSigma;
    options_.init = InitMethod::kUniform;
    options_.uniform_value = 20.0;
    options_.function_tolerance = 1e-5;
    options_.uncertainty = UncertaintyMode::kOff;
  }

  EstimatorSummary FitWith(const std::string& smoothness) {
    options_.smoothness = SmoothnessFromText(smoothness);
    return Estimate(scene_, target_, options_);
  }

  // RMS error of the logarithms.
  double Error(const EstimatorSummary& summary) const {
    return std::sqrt(
        (summary.parameters.array() / truth_.array()).log().square().mean());
  }

  Scene scene_;
  Eigen::VectorXd truth_;
  Observations target_;
  EstimatorOptions options_;
};

TEST_F(SmoothnessFitTest, AFieldIsFoundWhereDataAloneLeaveItOpen) {
  const EstimatorSummary smooth = FitWith("stiffness=10");
  EXPECT_TRUE(smooth.usable()) << smooth.message;
  EXPECT_LT(Error(smooth), 0.4);
  EXPECT_LT(Error(smooth), 0.3 * Error(FitWith("")));
  // Too smooth is no better.
  EXPECT_LT(Error(smooth), 0.7 * Error(FitWith("stiffness=1e5")));
}

TEST_F(SmoothnessFitTest, HeldOutFramesChooseAWeightNearTheBest) {
  const EstimatorSummary chosen = FitWith("stiffness=auto");
  EXPECT_TRUE(chosen.usable()) << chosen.message;
  EXPECT_EQ(chosen.num_frames, kFrames);
  EXPECT_TRUE(test::HasNote(chosen, "best from the first 32"));
  ASSERT_EQ(chosen.smoothness.size(), 1u);
  const std::vector<SmoothnessCandidate>& candidates = chosen.smoothness_candidates;
  ASSERT_GE(candidates.size(), 4u);
  double best_error = std::numeric_limits<double>::infinity(), best_weight = 0.0;
  int num_chosen = 0, iterations = 0;
  for (const SmoothnessCandidate& candidate : candidates) {
    const double error =
        Error(FitWith("stiffness=" + std::to_string(candidate.weight)));
    if (error < best_error) {
      best_error = error;
      best_weight = candidate.weight;
    }
    num_chosen += candidate.is_chosen;
    iterations += candidate.iterations;
    if (!candidate.is_chosen) continue;
    EXPECT_EQ(candidate.weight, chosen.smoothness[0].weight);
    for (const SmoothnessCandidate& other : candidates) {
      EXPECT_LE(candidate.held_out_cost, other.held_out_cost);
    }
  }
  EXPECT_EQ(num_chosen, 1);
  EXPECT_GT(chosen.iterations, iterations);
  EXPECT_LE(std::abs(std::log10(chosen.smoothness[0].weight / best_weight)), 1.01);
  EXPECT_LT(Error(chosen), 1.2 * best_error);
}

// What neighbours are known to be narrows the error bars, and honestly so.
TEST_F(SmoothnessFitTest, ErrorBarsKnowTheNeighbours) {
  options_.uncertainty = UncertaintyMode::kOn;
  const EstimatorSummary alone = FitWith("stiffness=0.0001");
  const EstimatorSummary smooth = FitWith("stiffness=10");
  ASSERT_TRUE(smooth.uncertainty.ok) << smooth.uncertainty.message;
  const BlockUncertainty& block = smooth.uncertainty.blocks[0];
  // Errors over their reported deviations: 127 numbers, of which some are correlated.
  const Eigen::ArrayXd scaled =
      (smooth.parameters.array() / truth_.array()).log() / block.relative.array();
  EXPECT_LT(std::sqrt(scaled.square().mean()), 2.0);
  EXPECT_GT(std::sqrt(scaled.square().mean()), 0.3);
  EXPECT_LT(block.relative.maxCoeff(),
            0.1 * alone.uncertainty.blocks[0].relative.maxCoeff());
}

// Two captures of one cloth, pinned differently: each holds out its own last frames.
TEST_F(SmoothnessFitTest, SeveralCapturesHoldOutTheirLastFrames) {
  CapturedMotion side = {scene_, target_, "side"};
  CapturedMotion corners = side;
  corners.name = "corners";
  UnpinAll(&corners.scene.objects[0]);
  PinVertices({0, 6, 42, 48}, &corners.scene.objects[0]);
  corners.observations = test::OwnMotion(corners.scene, 20);
  AddNoise(corners.scene, kSigma, 12, &corners.observations);
  corners.observations.sigma = kSigma;
  options_.smoothness = SmoothnessFromText("stiffness=auto");
  const EstimatorSummary both = Estimate({side, corners}, options_);
  ASSERT_TRUE(both.usable()) << both.message;
  EXPECT_TRUE(test::HasNote(both, "last 8 frames best from the first 32"));
  ASSERT_EQ(both.captures.size(), 2u);
  EXPECT_EQ(both.captures[1].num_frames, 20);
  ASSERT_GE(both.smoothness_candidates.size(), 4u);
  // More is known than from one of them, of more springs.
  const Eigen::VectorXd truth = JointLayout({&side.scene, &corners.scene}, true)
                                    .Extract({&side.scene, &corners.scene});
  ASSERT_EQ(both.parameters.size(), truth.size());
  const double error =
      std::sqrt((both.parameters.array() / truth.array()).log().square().mean());
  EXPECT_LT(error, Error(FitWith("stiffness=10")));
  options_.smoothness = SmoothnessFromText("stiffness=auto");
  corners.observations = test::OwnMotion(corners.scene, 4);
  corners.observations.sigma = kSigma;
  try {
    Estimate({side, corners}, options_);
    ADD_FAILURE() << "accepted";
  } catch (const SceneError& refused) {
    EXPECT_THAT(refused.what(), HasSubstr("corners: smoothness with a weight"));
  }
}

TEST_F(SmoothnessFitTest, TimeAndInterruptionsEndTheChoice) {
  int iterations = 0;
  options_.progress = [&](const IterationReport& report) {
    EXPECT_GE(report.iteration, iterations);  // counted through
    iterations = report.iteration;
  };
  options_.interrupted = [&] { return iterations >= 5; };
  const EstimatorSummary interrupted = FitWith("stiffness=auto");
  EXPECT_EQ(interrupted.termination, Termination::kInterrupted);
  EXPECT_EQ(interrupted.num_frames, 32);
  EXPECT_EQ(interrupted.smoothness_candidates.size(), 1u);
  EXPECT_TRUE(std::isfinite(interrupted.final_cost));
  EXPECT_TRUE(test::HasNote(interrupted, "stopped while weights were tried"));
  options_.interrupted = nullptr;
  iterations = 0;
  options_.max_seconds = 0.0;
  const EstimatorSummary late = FitWith("stiffness=auto");
  EXPECT_EQ(late.termination, Termination::kMaxSeconds);
}

TEST_F(SmoothnessFitTest, AResumedFitKeepsTheWeightThatWasChosen) {
  const test::TempDir folder;
  options_.checkpoint_path = folder.File("fit.json");
  const EstimatorSummary whole = FitWith("stiffness=auto");
  options_.resume_path = options_.checkpoint_path;
  const EstimatorSummary resumed = FitWith("stiffness=auto");
  EXPECT_TRUE(resumed.usable()) << resumed.message;
  EXPECT_TRUE(resumed.smoothness_candidates.empty());
  EXPECT_EQ(resumed.smoothness[0].weight, whole.smoothness[0].weight);
  EXPECT_LE(resumed.final_cost, whole.final_cost * (1.0 + 1e-12));
  EXPECT_LT((resumed.parameters - whole.parameters).norm(),
            0.05 * whole.parameters.norm());
  try {
    FitWith("stiffness@0=auto");
    ADD_FAILURE() << "accepted";
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(), HasSubstr("another smoothness (stiffness=auto:"));
  }
}

TEST_F(SmoothnessFitTest, AChoiceWithoutFramesOrNoiseIsRefused) {
  const auto error = [&] {
    try {
      FitWith("stiffness=auto");
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  options_.num_frames = 4;
  EXPECT_THAT(error(), HasSubstr("needs 5 frames, there are 4"));
  options_.num_frames = 0;
  target_.sigma = 0.0;
  EXPECT_THAT(error(), HasSubstr("--sigma"));
  target_.sigma = kSigma;
  target_.positions[0].rightCols(10).setConstant(std::nan(""));
  EXPECT_THAT(error(),
              HasSubstr("no free vertex is observed in the frames from 32 on"));
}

}  // namespace
}  // namespace dpe
