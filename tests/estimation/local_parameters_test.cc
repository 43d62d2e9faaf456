// Hundreds of unknowns: every mass, every stiffness, both.
#include <gtest/gtest.h>

#include "dpe/engine/cloth_builder.h"
#include "dpe/estimation/estimator.h"
#include "estimation/fit_support.h"

namespace dpe {
namespace {

TEST(LocalParametersTest, MassAndStiffnessTogetherOnSide) {
  Scene scene = MakePresetScene(ScenePreset::kSide);
  ApplySettings("LL", &scene);
  const EstimatorSummary summary =
      Estimate(scene, test::OwnMotion(scene, 100), EstimatorOptions());
  EXPECT_EQ(summary.termination, Termination::kConverged) << summary.message;
  EXPECT_LT(summary.final_rms, 1e-8);
  EXPECT_LT(ParameterDeviationPercent(summary, scene), 1e-3);
}

TEST(LocalParametersTest, LbfgsFindsTheMassesOfCornersFromAPerturbedStart) {
  Scene scene = MakePresetScene(ScenePreset::kCorners);
  ApplySettings("Ln", &scene);
  EstimatorOptions options;
  options.solver = SolverType::kLbfgs;
  options.init = InitMethod::kScene;
  options.init_perturbation = 0.2;
  options.seed = 1;
  options.max_iterations = 60;
  const EstimatorSummary summary =
      Estimate(scene, test::OwnMotion(scene, 100), options);
  EXPECT_EQ(summary.solver, "lbfgs");
  EXPECT_EQ(summary.jacobian, "gradient");
  EXPECT_GT(summary.initial_rms, 1e-2);
  EXPECT_LT(summary.final_rms, 1e-4);
}

TEST(LocalParametersTest, LmFindsTheMassesOfCornersFromOneFarValue) {
  Scene scene = MakePresetScene(ScenePreset::kCorners);
  ApplySettings("Ln", &scene);
  EstimatorOptions options;
  options.init = InitMethod::kUniform;
  options.uniform_value = 0.1;
  options.num_frames = 30;
  const EstimatorSummary summary = Estimate(scene, test::OwnMotion(scene, 30), options);
  EXPECT_EQ(summary.termination, Termination::kConverged) << summary.message;
  EXPECT_LT(summary.final_rms, 1e-10);
  EXPECT_LT(ParameterDeviationPercent(summary, scene), 1e-3);
}

}  // namespace
}  // namespace dpe
