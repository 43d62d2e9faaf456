// Uncertainty of real scenes, whose undetermined directions are known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dpe/estimation/trajectory_cost.h"
#include "dpe/estimation/uncertainty.h"
#include "fit_support.h"
#include "support/test_scenes.h"
#include "uncertainty_support.h"

namespace dpe {
namespace {

using test::AnyContains;
using ::testing::HasSubstr;

constexpr double kSigma = 1e-3;  // m
constexpr int kFrames = 40;

// At the scene's own values, observed with noise of kSigma.
Uncertainty OwnUncertainty(const Scene& scene, const Observations& observations,
                           const Eigen::MatrixXd& priors = {}) {
  TrajectoryEvaluator evaluator(scene, MakePositionCosts(scene, observations, kFrames));
  const test::LinearProblem problem(scene);
  EXPECT_TRUE(evaluator.Evaluate(problem.q) && evaluator.EvaluateJacobian());
  UncertaintyInput input = problem.Input(evaluator.jacobian() / kSigma);
  input.prior_rows = priors;
  return ComputeUncertainty(input);
}

Scene SideWithoutDrag(const std::string& settings) {
  Scene scene = test::MakeDerivativeScene("side", 6);
  scene.objects[0].drag_coefficient = 0.0;
  ApplySettings(settings, &scene);
  return scene;
}

// A free vertex on a spring of its own, which hangs from a pin beside the cloth.
// Returns the number of the spring.
int AddPendulum(ClothObject* object) {
  const int n = object->num_vertices();
  object->positions.conservativeResize(3 * (n + 2));
  object->positions.tail<6>() << 9.0, 0.0, 0.0, 9.5, -0.5, 0.0;
  object->velocities = Eigen::VectorXd::Zero(3 * (n + 2));
  object->mass.conservativeResize(n + 2);
  object->mass.tail<2>().setConstant(0.02);
  object->is_fixed.push_back(1);
  object->is_fixed.push_back(0);
  object->springs.push_back({n, n + 1});
  object->stiffness.conservativeResize(object->num_springs());
  object->stiffness.tail<1>().setConstant(25.0);
  if (!object->spring_kind.empty()) object->spring_kind.push_back(SpringKind::kStretch);
  return object->num_springs() - 1;
}

TEST(UncertaintySceneTest, TheScaleOfMassAndStiffnessIsFoundAndNamed) {
  for (const char* settings : {"GG", "GR", "GL"}) {
    SCOPED_TRACE(settings);
    const Scene scene = SideWithoutDrag(settings);
    const Uncertainty result = OwnUncertainty(scene, test::OwnMotion(scene, kFrames));
    ASSERT_TRUE(result.ok) << result.message;
    EXPECT_EQ(result.rank, static_cast<int>(result.names.size()) - 1);
    ASSERT_FALSE(result.directions.empty());
    EXPECT_TRUE(result.directions[0].is_exact);
    EXPECT_EQ(result.directions[0].text,
              "mass and stiffness of object 0 scale together: only their ratio was "
              "determined");
    EXPECT_TRUE(std::isinf(result.blocks[0].standard_deviations[0]));
    EXPECT_TRUE(std::isinf(result.blocks[1].standard_deviations[0]));
  }
}

TEST(UncertaintySceneTest, GroupsOfOneKindOfSpringAreNamedByIt) {
  const Scene scene = SideWithoutDrag("nR");
  const Uncertainty result = OwnUncertainty(scene, test::OwnMotion(scene, kFrames));
  EXPECT_THAT(result.names, ::testing::ElementsAre("the stretch stiffness of object 0",
                                                   "the shear stiffness of object 0",
                                                   "the bend stiffness of object 0"));
  EXPECT_THAT(UncertaintyLines(result)[2],
              ::testing::MatchesRegex("the bend stiffness of object 0: .* \\+- .* N/m "
                                      "\\(.* %\\)"));
}

TEST(UncertaintySceneTest, DampingDoesNotFixTheScaleAndIsDetermined) {
  Scene scene = SideWithoutDrag("GG");
  scene.objects[0].estimate_damping = scene.objects[0].estimate_drag = true;
  scene.objects[0].drag_coefficient = 0.1;
  const Uncertainty result = OwnUncertainty(scene, test::OwnMotion(scene, kFrames));
  ASSERT_EQ(result.directions.size(), 1u);
  EXPECT_EQ(
      result.directions[0].text,
      "mass, stiffness and drag of object 0 scale together: only their ratios were "
      "determined");
  EXPECT_EQ(result.blocks[2].kind, "damping");
  EXPECT_LT(result.blocks[2].relative[0], 0.1);
  EXPECT_EQ(result.blocks[2].flags[0], 0u);
}

TEST(UncertaintySceneTest, AKnownDragFixesTheScaleAsFarAsItIsFelt) {
  Scene scene = test::MakeDerivativeScene("side", 6);
  ApplySettings("GG", &scene);
  const Uncertainty felt = OwnUncertainty(scene, test::OwnMotion(scene, kFrames));
  EXPECT_EQ(felt.rank, 2);
  EXPECT_TRUE(felt.directions.empty());
  EXPECT_LT(felt.blocks[0].relative[0], 0.01);

  scene.objects[0].drag_coefficient *= 1e-6;
  const Uncertainty faint = OwnUncertainty(scene, test::OwnMotion(scene, kFrames));
  EXPECT_EQ(faint.rank, 2);
  ASSERT_EQ(faint.directions.size(), 1u);
  EXPECT_FALSE(faint.directions[0].is_exact);
  EXPECT_EQ(faint.directions[0].pattern, DirectionPattern::kRatio);
  EXPECT_GT(faint.directions[0].data_std, 1.0);
  EXPECT_EQ(faint.blocks[0].flags[0], kWeaklyDetermined);
  // Of the ratio, for all that, next to everything is known.
  const double ratio =
      faint.covariance(0, 0) + faint.covariance(1, 1) - 2.0 * faint.covariance(0, 1);
  EXPECT_LT(ratio, 1e-4 * faint.covariance(0, 0));
}

TEST(UncertaintySceneTest, APriorOnTheMassFixesTheScale) {
  const Scene scene = SideWithoutDrag("GG");
  const Uncertainty result =
      OwnUncertainty(scene, test::OwnMotion(scene, kFrames),
                     Eigen::RowVectorXd::Unit(2, 0) / 0.05);  // to 5 %
  EXPECT_NEAR(result.blocks[0].relative[0], 0.05, 1e-6);
  EXPECT_EQ(result.blocks[0].flags[0], kPriorAlone);
  EXPECT_NEAR(result.blocks[1].relative[0], 0.05, 1e-3);
  EXPECT_THAT(result.directions[0].text,
              HasSubstr("only their ratio was determined; the prior fixes it to 5 %"));
}

TEST(UncertaintySceneTest, ASpringThatNoObservedVertexFeelsIsNamed) {
  Scene scene = SideWithoutDrag("nL");
  const int spring = AddPendulum(&scene.objects[0]);
  const int bob = scene.objects[0].num_vertices() - 1;
  Observations observations = test::OwnMotion(scene, kFrames);
  const Uncertainty seen = OwnUncertainty(scene, observations);
  observations.positions[0].middleRows(3 * bob, 3).setConstant(std::nan(""));
  const Uncertainty unseen = OwnUncertainty(scene, observations);
  EXPECT_EQ(seen.rank, static_cast<int>(seen.names.size()));
  EXPECT_EQ(unseen.rank, seen.rank - 1);
  const std::string name = "the stiffness of spring " + std::to_string(spring) +
                           " of object 0 (vertices " + std::to_string(bob - 1) + "-" +
                           std::to_string(bob) + ")";
  EXPECT_EQ(unseen.names.back(), name);
  EXPECT_EQ(unseen.blocks[0].flags.back(), kNoInfluence | kUndetermined);
  ASSERT_FALSE(unseen.directions.empty());
  EXPECT_EQ(unseen.directions[0].text, name + " has no effect on what was observed");
  EXPECT_TRUE(AnyContains(unseen.statements, name + " has no effect"));
  // The others do not notice.
  for (int k = 0; k + 1 < unseen.blocks[0].values.size(); ++k) {
    EXPECT_NEAR(unseen.blocks[0].relative[k], seen.blocks[0].relative[k],
                1e-8 * seen.blocks[0].relative[k]);
  }
}

TEST(UncertaintySceneTest, InitialStatesAreInMetresAndMetresPerSecond) {
  Scene scene = test::MakeDerivativeScene("two_objects", 4);
  ApplySettings("nn,nG", &scene);
  ClothObject& cloth = scene.objects[1];
  cloth.rest_length = RestLengths(cloth);
  cloth.estimate_initial_velocity = cloth.estimate_initial_position = true;
  const Observations all = test::OwnMotion(scene, kFrames);
  const Uncertainty seen = OwnUncertainty(scene, all);
  ASSERT_EQ(seen.blocks.size(), 3u);
  EXPECT_EQ(seen.blocks[2].kind, "initial position");
  EXPECT_EQ(seen.blocks[2].unit, "m");
  EXPECT_THAT(seen.names.back(), HasSubstr("the initial position along z of vertex "));
  EXPECT_TRUE(std::isnan(seen.blocks[2].relative[0]));
  EXPECT_LT(seen.blocks[2].standard_deviations.maxCoeff(), 0.5);
  EXPECT_NEAR(seen.blocks[2].natural_unit, 0.25 * 7.0, 1e-12);  // half of 3.5 m
}

TEST(UncertaintySceneTest, TwoObjectsAreNamedApart) {
  Scene scene = test::MakeDerivativeScene("two_objects", 4);
  for (ClothObject& object : scene.objects) object.drag_coefficient = 0.0;
  ApplySettings("GG,GL", &scene);
  const Uncertainty result = OwnUncertainty(scene, test::OwnMotion(scene, kFrames));
  ASSERT_GE(result.directions.size(), 2u);
  EXPECT_THAT(result.directions[0].text, HasSubstr("mass and stiffness of object 0"));
  EXPECT_THAT(result.directions[1].text, HasSubstr("mass and stiffness of object 1"));
  EXPECT_EQ(result.rank, static_cast<int>(result.names.size()) - 2);
}

}  // namespace
}  // namespace dpe
