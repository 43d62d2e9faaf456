#include "dpe/estimation/estimator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "dpe/engine/cloth_builder.h"
#include "estimation/fit_support.h"
#include "support/test_scenes.h"

namespace dpe {
namespace {

using ::testing::HasSubstr;

constexpr int kFrames = 20;

Scene SmallScene(const std::string& name, const std::string& settings) {
  Scene scene = test::MakeDerivativeScene(name, 5);
  test::Perturb(2, &scene);
  ApplySettings(settings, &scene);
  return scene;
}

TEST(EstimatorTest, TheStartFromInverseDynamicsIsTheAnswerForExactPositions) {
  const Scene scene = SmallScene("side", "LL");
  const EstimatorSummary summary =
      Estimate(scene, test::OwnMotion(scene, kFrames), EstimatorOptions());
  EXPECT_EQ(summary.termination, Termination::kConverged);
  EXPECT_EQ(summary.init, "inverse_dynamics");
  EXPECT_LT(summary.final_rms, 1e-11);
  EXPECT_LT(ParameterDeviationPercent(summary, scene), 1e-5);
  EXPECT_EQ(summary.jacobian_evaluations, 0);
}

// Nothing that the fit computes may know the answer: not the start, not the scaling,
// not the damping coefficients that multiply mass and stiffness.
TEST(EstimatorTest, TheSceneValuesOfWhatIsEstimatedDoNotMatter) {
  for (const char* settings : {"nL", "Ln", "GG", "nG"}) {
    for (const InitMethod init : {InitMethod::kAuto, InitMethod::kUniform}) {
      const Scene scene = SmallScene("side", settings);
      const Observations target = test::OwnMotion(scene, kFrames);
      EstimatorOptions options;
      options.init = init;
      options.uniform_value = 5.0;
      options.max_iterations = 5;
      const EstimatorSummary a = Estimate(scene, target, options);
      const EstimatorSummary b =
          Estimate(test::WithEstimatesOverwritten(scene, 0.37), target, options);
      EXPECT_LT(((a.parameters - b.parameters).array() / a.parameters.array())
                    .abs()
                    .maxCoeff(),
                1e-9)
          << settings;
      EXPECT_EQ(a.initial_cost, b.initial_cost) << settings;
      EXPECT_EQ(a.iterations, b.iterations) << settings;
    }
  }
}

TEST(EstimatorTest, LmFindsTheParametersFromAPerturbedStart) {
  const Scene scene = SmallScene("corners", "LG");
  Scene truth = scene;
  const ParameterLayout layout(scene);
  layout.Insert(layout.Extract(scene), &truth);
  EstimatorOptions options;
  options.init = InitMethod::kScene;
  options.init_perturbation = 0.3;
  options.seed = 4;
  options.horizon = Horizon::kFull;
  std::vector<IterationReport> reports;
  options.progress = [&](const IterationReport& r) { reports.push_back(r); };
  const EstimatorSummary summary =
      Estimate(truth, test::OwnMotion(truth, kFrames), options);
  EXPECT_EQ(summary.termination, Termination::kConverged) << summary.message;
  EXPECT_EQ(summary.solver, "lm");
  EXPECT_GT(summary.initial_rms, 1e-4);
  EXPECT_LT(summary.final_rms, 1e-11);
  EXPECT_LT(ParameterDeviationPercent(summary, truth), 1e-5);
  ASSERT_EQ(static_cast<int>(reports.size()), summary.iterations + 1);
  for (size_t i = 0; i < reports.size(); ++i) {
    EXPECT_EQ(reports[i].iteration, static_cast<int>(i));
    EXPECT_LE(reports[i].cost, reports[i > 0 ? i - 1 : 0].cost);
  }
  EXPECT_NEAR(reports[0].rms, summary.initial_rms, 1e-12);
}

TEST(EstimatorTest, TangentAndAdjointGiveTheSameFit) {
  const Scene scene = SmallScene("flag", "LL");
  const Observations target = test::OwnMotion(scene, 8);
  EstimatorOptions options;
  options.init = InitMethod::kScene;
  options.init_perturbation = 0.1;
  options.max_iterations = 3;
  options.jacobian = JacobianMethod::kTangent;
  const EstimatorSummary tangent = Estimate(scene, target, options);
  options.jacobian = JacobianMethod::kAdjoint;
  const EstimatorSummary adjoint = Estimate(scene, target, options);
  EXPECT_EQ(tangent.jacobian, "tangent");
  EXPECT_EQ(adjoint.jacobian, "adjoint");
  EXPECT_NEAR(tangent.final_rms, adjoint.final_rms, 1e-7 * tangent.initial_rms);
  EXPECT_LT((tangent.parameters - adjoint.parameters).norm(),
            1e-6 * tangent.parameters.norm());
}

TEST(EstimatorTest, TheFittedSceneReproducesTheFit) {
  const Scene scene = SmallScene("side", "nG");
  const Observations target = test::OwnMotion(scene, kFrames);
  const EstimatorSummary summary = Estimate(scene, target, EstimatorOptions());
  EXPECT_EQ(summary.termination, Termination::kConverged) << summary.message;
  EXPECT_GT(summary.final_rms, 1e-4);  // one stiffness cannot reproduce them all
  EXPECT_NEAR(test::RmsOfScene(summary.scene, target, kFrames), summary.final_rms,
              1e-12 * summary.initial_rms);
  // Fixed-fixed springs keep their values.
  const EstimatedBlock& block = summary.blocks[0];
  ASSERT_FALSE(block.inactive.empty());
  for (const int spring : block.inactive) {
    EXPECT_EQ(summary.scene.objects[0].stiffness[spring],
              scene.objects[0].stiffness[spring]);
  }
  EXPECT_EQ(block.kind, "stiffness");
  EXPECT_EQ(block.mode, 'G');
  EXPECT_EQ(block.unit, "N/m");
  EXPECT_TRUE(std::isnan(ParameterDeviationPercent(summary, scene)));
}

TEST(EstimatorTest, GapsAreFittedAroundFromTheScreen) {
  Scene scene = SmallScene("side", "GG");
  const ParameterLayout layout(scene);
  layout.Insert(layout.Extract(scene), &scene);
  Observations target = test::OwnMotion(scene, kFrames);
  for (int f = 1; f < kFrames; f += 2) {
    target.positions[0]
        .col(f)
        .segment<3>(3 * (f % 7))
        .setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  const EstimatorSummary summary = Estimate(scene, target, EstimatorOptions());
  EXPECT_EQ(summary.init, "screen");
  EXPECT_EQ(summary.termination, Termination::kConverged) << summary.message;
  EXPECT_LT(summary.final_rms, 1e-9);
  EXPECT_LT(ParameterDeviationPercent(summary, scene), 1e-3);
  EXPECT_NEAR(test::RmsOfScene(summary.scene, target, kFrames), summary.final_rms,
              1e-12 * summary.initial_rms);
}

TEST(EstimatorTest, KeepsTheTotalMassWhereTheScaleIsFree) {
  Scene scene = SmallScene("corners", "LL");
  scene.objects[0].drag_coefficient = 0.0;
  const Observations target = test::OwnMotion(scene, kFrames);
  EstimatorOptions options;
  options.init = InitMethod::kUniform;
  options.uniform_value = 3.0;
  options.max_iterations = 5;
  const EstimatorSummary summary = Estimate(scene, target, options);
  EXPECT_TRUE(test::HasNote(summary, "total mass"));
  double expected = 0.0, found = 0.0;
  for (int v = 0; v < scene.objects[0].num_vertices(); ++v) {
    if (scene.objects[0].is_fixed[v]) continue;
    expected += scene.objects[0].mass[v];
    found += summary.scene.objects[0].mass[v];
  }
  EXPECT_NEAR(found, expected, 1e-12 * expected);
}

TEST(EstimatorTest, SeveralStepsPerFrameAreFinishedByLm) {
  Scene scene = SmallScene("side", "LG");
  scene.steps_per_frame = 3;
  const ParameterLayout layout(scene);
  layout.Insert(layout.Extract(scene), &scene);
  const EstimatorSummary summary =
      Estimate(scene, test::OwnMotion(scene, kFrames), EstimatorOptions());
  EXPECT_EQ(summary.init, "inverse_dynamics");
  EXPECT_GT(summary.initial_rms, 1e-5);
  EXPECT_LT(summary.final_rms, 1e-10);
  EXPECT_LT(ParameterDeviationPercent(summary, scene), 1e-4);
  EXPECT_TRUE(test::HasNote(summary, "a start, not the answer"));
}

TEST(EstimatorTest, InitialVelocityWindAndDragAreFittedToo) {
  Scene scene = SmallScene("flag", "nG");
  scene.objects[0].estimate_initial_velocity = true;
  scene.objects[0].estimate_drag = true;
  scene.estimate_wind = true;
  const ParameterLayout layout(scene);
  layout.Insert(layout.Extract(scene), &scene);
  const EstimatorSummary summary =
      Estimate(scene, test::OwnMotion(scene, kFrames), EstimatorOptions());
  EXPECT_EQ(summary.termination, Termination::kConverged) << summary.message;
  EXPECT_LT(summary.final_rms, 1e-10);
  EXPECT_LT(ParameterDeviationPercent(summary, scene), 1e-3);
}

}  // namespace
}  // namespace dpe
