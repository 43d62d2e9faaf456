// Whole fits with priors: where the answer is, how sure it is, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "dpe/estimation/estimator.h"
#include "dpe/estimation/trajectory_evaluator.h"
#include "estimation/fit_support.h"
#include "estimation/uncertainty_support.h"
#include "fingerprint.h"
#include "support/test_scenes.h"

namespace dpe {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kFrames = 25;
constexpr double kSigma = 0.005;  // m

class PriorsFitTest : public ::testing::Test {
 protected:
  // Stiffness per kind of spring and damping, every second vertex seen, with noise.
  PriorsFitTest() {
    ApplySettings("nR", &scene_);
    scene_.objects[0].estimate_damping = true;
    const ParameterLayout layout(scene_);
    truth_ = layout.Extract(scene_);
    layout.Insert(truth_, &scene_);
    target_ = test::OwnMotion(scene_, kFrames);
    AddNoise(scene_, kSigma, 3, &target_);
    for (int v = 1; v < scene_.objects[0].num_vertices(); v += 2) {
      target_.positions[0].middleRows(3 * v, 3).setConstant(std::nan(""));
    }
    target_.sigma = kSigma;
  }

  EstimatorSummary FitWith(const std::string& priors) {
    options_.priors = PriorsFromText(priors);
    EstimatorSummary summary = Estimate(scene_, target_, options_);
    EXPECT_TRUE(summary.usable()) << summary.message;
    return summary;
  }

  // How far from the least total cost, in posterior standard deviations, and the
  // posterior covariance, from the data alone and priors written out here:
  // stiffness:lognormal:30,0.2 and damping:normal:0.3,0.05.
  void Posterior(const Eigen::VectorXd& p, double* distance,
                 Eigen::MatrixXd* covariance) {
    TrajectoryEvaluator evaluator(scene_, MakePositionCosts(scene_, target_, kFrames));
    Eigen::VectorXd gradient;
    ASSERT_TRUE(evaluator.Evaluate(evaluator.map().ToCoordinates(p)) &&
                evaluator.EvaluateJacobian() && evaluator.EvaluateGradient(&gradient));
    Eigen::MatrixXd information =
        evaluator.jacobian().transpose() * evaluator.jacobian();
    for (int j = 0; j < 3; ++j) {
      gradient[j] += std::log(p[j] / 30.0) / (0.2 * 0.2);
      information(j, j) += 1.0 / (0.2 * 0.2);
    }
    gradient[3] += p[3] * (p[3] - 0.3) / (0.05 * 0.05);
    information(3, 3) += p[3] * p[3] / (0.05 * 0.05);
    *covariance = information.inverse();
    *distance = std::sqrt(gradient.dot(*covariance * gradient));
  }

  Scene scene_ = test::MakeDerivativeScene("side", 6);
  Eigen::VectorXd truth_;
  Observations target_;
  EstimatorOptions options_;
};

TEST_F(PriorsFitTest, TheAnswerHasTheLeastTotalCostAndTheReportedCovariance) {
  for (const SolverType solver :
       {SolverType::kLevenbergMarquardt, SolverType::kLbfgs}) {
    options_.solver = solver;
    const EstimatorSummary free = FitWith("");
    const EstimatorSummary summary =
        FitWith("stiffness:lognormal:30,0.2;damping:normal:0.3,0.05");
    double distance = 0.0;
    Eigen::MatrixXd covariance;
    Posterior(summary.parameters, &distance, &covariance);
    EXPECT_LT(distance, 1e-3);
    ASSERT_TRUE(summary.uncertainty.ok) << summary.uncertainty.message;
    EXPECT_LT((summary.uncertainty.covariance - covariance).norm(),
              1e-8 * covariance.norm());
    // The priors do something: they contradict the data.
    Posterior(free.parameters, &distance, &covariance);
    EXPECT_GT(distance, 1.0);
    EXPECT_GT(summary.prior_cost, 1.0);
    EXPECT_EQ(free.prior_cost, 0.0);
    EXPECT_GT(summary.final_cost - summary.prior_cost, free.final_cost);
  }
}

TEST_F(PriorsFitTest, ATinySpreadPinsAndAHugeOneChangesNothing) {
  const EstimatorSummary free = FitWith("");
  const EstimatorSummary pinned = FitWith("damping:lognormal:0.3,1e-6");
  EXPECT_NEAR(pinned.parameters[3], 0.3, 1e-5);
  EXPECT_GT(std::abs(free.parameters[3] - 0.3), 0.05);
  EXPECT_NEAR(pinned.uncertainty.blocks[1].relative[0], 1e-6, 1e-9);
  EXPECT_EQ(pinned.uncertainty.blocks[1].flags[0], kPriorAlone);
  EXPECT_TRUE(
      test::AnyContains(pinned.uncertainty.statements,
                        "damping of object 0 is determined by its prior alone"));
  const EstimatorSummary wide =
      FitWith("damping:lognormal:0.3,1e6;stiffness:normal:3,1e9");
  EXPECT_LT((wide.parameters - free.parameters).norm(), 1e-6 * free.parameters.norm());
  EXPECT_LT((wide.uncertainty.covariance - free.uncertainty.covariance).norm(),
            1e-6 * free.uncertainty.covariance.norm());
  EXPECT_EQ(wide.uncertainty.blocks[1].flags[0], 0u);
}

TEST_F(PriorsFitTest, APriorOnTheMassDecidesTheScaleThatMotionDoesNot) {
  scene_.objects[0].drag_coefficient = 0.0;
  scene_.objects[0].estimate_damping = false;
  ApplySettings("GG", &scene_);
  const Eigen::VectorXd truth = ParameterLayout(scene_).Extract(scene_);
  ParameterLayout(scene_).Insert(truth, &scene_);
  target_ = test::OwnMotion(scene_, kFrames);
  target_.sigma = kSigma;
  const Prior twice = {ParameterKind::kMass, "", -1, PriorDistribution::kLogNormal,
                       2.0 * truth[0],       0.1};
  const EstimatorSummary summary = FitWith(PriorText(twice));
  EXPECT_NEAR(summary.parameters[0], 2.0 * truth[0], 1e-4 * truth[0]);
  EXPECT_NEAR(summary.parameters[1], 2.0 * truth[1], 1e-2 * truth[1]);
  EXPECT_FALSE(test::HasNote(summary, "the total mass"));
  EXPECT_EQ(summary.uncertainty.blocks[0].flags[0], kPriorAlone);
  EXPECT_NEAR(summary.uncertainty.blocks[0].relative[0], 0.1, 1e-6);
  const EstimatorSummary without = FitWith("");
  EXPECT_NEAR(without.parameters[0], truth[0], 1e-9 * truth[0]);
  EXPECT_TRUE(test::HasNote(without, "the total mass"));
}

TEST_F(PriorsFitTest, WindAndInitialVelocityTakePriors) {
  Scene scene = test::MakeDerivativeScene("flag", 4);
  scene.objects[0].estimate_initial_velocity = scene.estimate_wind = true;
  ApplySettings("nG", &scene);
  scene.wind = {3.0, 0.0, 1.0};
  Observations target = test::OwnMotion(scene, 12);
  target.sigma = 0.02;
  options_.priors =
      PriorsFromText("wind[y]:normal:0.5,1e-5;initial_velocity:normal:0,1e-5");
  const EstimatorSummary summary = Estimate(scene, target, options_);
  ASSERT_TRUE(summary.usable()) << summary.message;
  EXPECT_NEAR(summary.scene.wind.y(), 0.5, 1e-4);
  EXPECT_LT(summary.scene.objects[0].velocities.norm(), 1e-3);
  EXPECT_EQ(summary.uncertainty.blocks.back().flags[1], kPriorAlone);
  EXPECT_EQ(summary.uncertainty.blocks.back().flags[0] & kPriorAlone, 0u);
}

// A prior is one, however many captures there are, but each has its own wind.
TEST_F(PriorsFitTest, SeveralCapturesShareOnePrior) {
  options_.priors = PriorsFromText("damping:lognormal:0.3,0.01");
  const std::vector<CapturedMotion> twice(2, {scene_, target_, ""});
  const EstimatorSummary summary = Estimate(twice, options_);
  ASSERT_TRUE(summary.usable()) << summary.message;
  const double r = std::log(summary.parameters[3] / 0.3) / 0.01;
  EXPECT_NEAR(summary.prior_cost, 0.5 * r * r, 1e-9 * summary.prior_cost);
  // The same data twice weigh twice as much against it.
  const EstimatorSummary once = FitWith("damping:lognormal:0.3,0.01");
  const double r_once = std::log(once.parameters[3] / 0.3) / 0.01;
  EXPECT_GT(std::abs(r), 1.5 * std::abs(r_once));
}

TEST_F(PriorsFitTest, WithoutNoiseAPriorIsRefused) {
  target_.sigma = 0.0;
  options_.priors = PriorsFromText("damping:lognormal:0.3,1");
  const auto error = [&] {
    try {
      Estimate(scene_, target_, options_);
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(error(), AllOf(HasSubstr("noise"), HasSubstr("--sigma")));
  target_.sigma = kSigma;
  options_.priors = PriorsFromText("drag:lognormal:0.3,1");
  EXPECT_THAT(error(), HasSubstr("\"drag:lognormal:0.3,1\""));
  options_.priors.clear();
  options_.smoothness = SmoothnessFromText("stiffness=3");
  EXPECT_THAT(error(), HasSubstr("mode L"));
}

TEST_F(PriorsFitTest, CheckpointsAreOfTheSamePriors) {
  Checkpoint checkpoint;
  checkpoint.problem = FingerprintOf({{&scene_, &target_, ""}}, options_);
  const auto error = [&] {
    try {
      RequireSameProblem(checkpoint, FingerprintOf({{&scene_, &target_, ""}}, options_),
                         "c");
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(error(), "accepted");
  options_.priors = PriorsFromText("drag:lognormal:0.3,1");
  options_.smoothness = SmoothnessFromText("stiffness=3");
  EXPECT_THAT(error(), AllOf(HasSubstr("priors (not given in the checkpoint, drag"),
                             HasSubstr("smoothness (not given")));
  checkpoint.problem = FingerprintOf({{&scene_, &target_, ""}}, options_);
  options_.smoothness = SmoothnessFromText("stiffness=4");
  EXPECT_THAT(error(),
              AllOf(HasSubstr("smoothness (stiffness=3 in the checkpoint, stiffness=4"),
                    Not(HasSubstr("priors"))));
}

}  // namespace
}  // namespace dpe
