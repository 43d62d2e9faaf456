#include "dpe/estimation/trajectory_problem.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "ceres_support.h"
#include "dpe/engine/simulator.h"
#include "support/derivative_checker.h"
#include "support/test_scenes.h"

namespace dpe {
namespace {

using test::CeresJacobianTimes;
using test::CeresResiduals;

constexpr int kFrames = 8;

// Away from the answer: the target is the motion of another, perturbed scene.
TrajectoryCosts CostsFor(const Scene& scene) {
  Scene other = scene;
  test::Perturb(5, &other);
  return MakePositionCosts(scene, ObserveAll(Simulator(other).Simulate(kFrames)),
                           kFrames);
}

Scene SceneWithEverythingEstimated(const std::string& name) {
  Scene scene = test::MakeDerivativeScene(name, 4);
  test::Perturb(3, &scene);
  test::EstimateEverything(ParameterMode::kLocal, &scene);
  return scene;
}

Eigen::VectorXd StartOf(const Scene& scene, TrajectoryEvaluator* evaluator) {
  return evaluator->map().ToCoordinates(evaluator->layout().Extract(scene));
}

class TrajectoryProblemTest
    : public ::testing::TestWithParam<std::pair<std::string, JacobianMethod>> {};

TEST_P(TrajectoryProblemTest, CeresJacobianAgreesWithDifferencesOfCeresResiduals) {
  const auto [name, method] = GetParam();
  const Scene scene = SceneWithEverythingEstimated(name);
  TrajectoryEvaluatorOptions options;
  options.jacobian = method;
  TrajectoryProblem problem(scene, CostsFor(scene), options);
  const Eigen::VectorXd q = StartOf(scene, problem.evaluator());
  const Eigen::VectorXd direction = test::RandomVector(static_cast<int>(q.size()), 9);
  const auto check = test::CheckDirectionalDerivative(
      [&](const Eigen::VectorXd& x) { return CeresResiduals(&problem, x); }, q,
      direction, CeresJacobianTimes(&problem, q, direction));
  EXPECT_LT(check.relative_error, 1e-6) << check;
  EXPECT_GT(check.norm, 0.0);
}

INSTANTIATE_TEST_SUITE_P(
    ScenesAndMethods, TrajectoryProblemTest,
    ::testing::Values(std::make_pair("flag", JacobianMethod::kTangent),
                      std::make_pair("flag", JacobianMethod::kAdjoint),
                      std::make_pair("two_objects", JacobianMethod::kTangent),
                      std::make_pair("two_objects", JacobianMethod::kAdjoint)),
    [](const auto& info) {
      return info.param.first +
             (info.param.second == JacobianMethod::kTangent ? "_tangent" : "_adjoint");
    });

TEST(TrajectoryEvaluatorTest, GradientIsJacobianTransposedTimesResiduals) {
  const Scene scene = SceneWithEverythingEstimated("two_objects");
  TrajectoryEvaluator evaluator(scene, CostsFor(scene));
  ASSERT_TRUE(evaluator.Evaluate(StartOf(scene, &evaluator)));
  ASSERT_TRUE(evaluator.EvaluateJacobian());
  Eigen::VectorXd gradient;
  ASSERT_TRUE(evaluator.EvaluateGradient(&gradient));
  const Eigen::VectorXd expected =
      evaluator.jacobian().transpose() * evaluator.residuals();
  EXPECT_LT((gradient - expected).norm(), 1e-10 * expected.norm());
  EXPECT_GT(expected.norm(), 0.0);
}

TEST(TrajectoryEvaluatorTest, DerivativesDoNotDependOnTheMemoryLimit) {
  Scene scene = SceneWithEverythingEstimated("two_objects");
  scene.steps_per_frame = 2;
  std::vector<Eigen::VectorXd> gradients;
  for (const std::size_t limit : {std::size_t{1} << 30, std::size_t{0}}) {
    TrajectoryEvaluatorOptions options;
    options.memory_limit_bytes = limit;
    TrajectoryEvaluator evaluator(scene, CostsFor(scene), options);
    EXPECT_EQ(evaluator.simulator()->options().memory_limit_bytes, limit);
    ASSERT_TRUE(evaluator.Evaluate(StartOf(scene, &evaluator)));
    gradients.emplace_back();
    ASSERT_TRUE(evaluator.EvaluateGradient(&gradients.back()));
  }
  EXPECT_LE((gradients[1] - gradients[0]).norm(), 1e-12 * gradients[0].norm());
}

TEST(TrajectoryEvaluatorTest, OneRolloutPerPointAndOneDerivativePassWhenAsked) {
  const Scene scene = SceneWithEverythingEstimated("flag");
  TrajectoryProblem problem(scene, CostsFor(scene));
  TrajectoryEvaluator* evaluator = problem.evaluator();
  const Eigen::VectorXd q = StartOf(scene, evaluator);
  CeresResiduals(&problem, q);
  EXPECT_EQ(evaluator->num_rollouts(), 1);
  EXPECT_EQ(evaluator->num_derivative_passes(), 0);
  CeresJacobianTimes(&problem, q, q);
  CeresResiduals(&problem, q);
  EXPECT_EQ(evaluator->num_rollouts(), 1);
  EXPECT_EQ(evaluator->num_derivative_passes(), 1);
  CeresResiduals(&problem, 1.01 * q);
  EXPECT_EQ(evaluator->num_rollouts(), 2);
}

// Its memory is used again from point to point.
TEST(TrajectoryEvaluatorTest, AJacobianHoldsNothingOfTheOneBefore) {
  const Scene scene = SceneWithEverythingEstimated("flag");
  for (const JacobianMethod method :
       {JacobianMethod::kTangent, JacobianMethod::kAdjoint}) {
    TrajectoryEvaluatorOptions options;
    options.jacobian = method;
    TrajectoryEvaluator evaluator(scene, CostsFor(scene), options);
    const Eigen::VectorXd q = StartOf(scene, &evaluator);
    ASSERT_TRUE(evaluator.Evaluate(q) && evaluator.EvaluateJacobian());
    const RowMajorMatrix first = evaluator.jacobian();
    ASSERT_TRUE(evaluator.Evaluate(1.01 * q) && evaluator.EvaluateJacobian());
    EXPECT_NE(evaluator.jacobian(), first);
    ASSERT_TRUE(evaluator.Evaluate(q) && evaluator.EvaluateJacobian());
    EXPECT_EQ(evaluator.jacobian(), first);
    EXPECT_GT(first.norm(), 0.0);
  }
}

TEST(TrajectoryEvaluatorTest, RemembersTheBestPoint) {
  const Scene scene = SceneWithEverythingEstimated("flag");
  TrajectoryEvaluator evaluator(scene, CostsFor(scene));
  const Eigen::VectorXd q = StartOf(scene, &evaluator);
  const Eigen::VectorXd other = q.array() + 0.5;
  ASSERT_TRUE(evaluator.Evaluate(q));
  const double cost = evaluator.cost();
  ASSERT_TRUE(evaluator.Evaluate(other));
  const bool first_is_better = cost < evaluator.cost();
  EXPECT_EQ(evaluator.best_cost(), std::min(cost, evaluator.cost()));
  EXPECT_EQ(evaluator.best_coordinates(), first_is_better ? q : other);
}

TEST(TrajectoryEvaluatorTest, HorizonCostsAddUpToTheCost) {
  const Scene scene = SceneWithEverythingEstimated("flag");
  TrajectoryEvaluator evaluator(scene, CostsFor(scene));
  const Eigen::VectorXd q = StartOf(scene, &evaluator);
  double part = 0.0, whole = 0.0;
  ASSERT_TRUE(evaluator.CostOverHorizon(q, 4, &part));
  ASSERT_TRUE(evaluator.CostOverHorizon(q, kFrames, &whole));
  ASSERT_TRUE(evaluator.Evaluate(q));
  EXPECT_NEAR(whole, evaluator.cost(), 1e-12 * whole);
  const int rows = evaluator.first_row(3);  // costs of frames 1, 2 and 3
  EXPECT_NEAR(part, 0.5 * evaluator.residuals().head(rows).squaredNorm(), 1e-12 * part);
  EXPECT_LT(part, whole);
}

TEST(TrajectoryProblemFailureTest, ARolloutThatBlowsUpMakesCeresEvaluationFail) {
  Scene scene = test::MakeDerivativeScene("side", 4);
  scene.integration_method = IntegrationMethod::kExplicitEuler;
  ApplySettings("nG", &scene);
  TrajectoryProblem problem(scene, CostsFor(scene));
  problem.set_coordinates(Eigen::VectorXd::Constant(1, std::log(1e9)));
  double cost = 0.0;
  EXPECT_FALSE(problem.least_squares()->Evaluate({}, &cost, nullptr, nullptr, nullptr));
  EXPECT_FALSE(problem.evaluator()->ok());
  EXPECT_NE(problem.evaluator()->message(), "");
  // A good point after a bad one works as ever.
  problem.set_coordinates(Eigen::VectorXd::Constant(1, std::log(10.0)));
  EXPECT_TRUE(problem.least_squares()->Evaluate({}, &cost, nullptr, nullptr, nullptr));
}

TEST(TrajectoryProblemFailureTest, AnInterruptedRolloutIsNotRemembered) {
  Scene scene = test::MakeDerivativeScene("side", 4);
  ApplySettings("nG", &scene);
  bool interrupt = true;
  TrajectoryEvaluatorOptions options;
  options.interrupted = [&] { return interrupt; };
  TrajectoryEvaluator evaluator(scene, CostsFor(scene), options);
  const Eigen::VectorXd q = Eigen::VectorXd::Constant(1, std::log(10.0));
  EXPECT_FALSE(evaluator.Evaluate(q));
  interrupt = false;
  EXPECT_TRUE(evaluator.Evaluate(q));
}

// Counts how often a rollout got as far as its costs.
class CountingCost : public TrajectoryCost {
 public:
  explicit CountingCost(int* count) : TrajectoryCost(1, {{0, 1}}), count_(count) {}

  bool Evaluate(const Trajectory& /*trajectory*/, double* residuals,
                std::vector<StateDerivative>* derivatives) const override {
    residuals[0] = 0.0;
    if (derivatives == nullptr) ++*count_;
    return true;
  }

 private:
  int* count_;
};

TEST(TrajectoryProblemFailureTest, StepsWhoseRolloutBlowsUpAreRejectedByCeres) {
  Scene scene = test::MakeDerivativeScene("side", 5);
  scene.integration_method = IntegrationMethod::kSymplecticEuler;
  ApplySettings("nL", &scene);
  int num_reached = 0;
  TrajectoryCosts costs =
      MakePositionCosts(scene, ObserveAll(Simulator(scene).Simulate(40)), 40);
  costs.push_back(std::make_unique<CountingCost>(&num_reached));
  TrajectoryProblem problem(scene, std::move(costs));
  const double start = std::log(1.0);
  problem.set_coordinates(
      Eigen::VectorXd::Constant(problem.evaluator()->num_parameters(), start));
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 30;
  ceres::Solver::Summary summary;
  ceres::Solve(options, problem.least_squares(), &summary);
  EXPECT_TRUE(summary.IsSolutionUsable()) << summary.message;
  EXPECT_LT(summary.final_cost, summary.initial_cost);
  EXPECT_LT(num_reached, problem.evaluator()->num_rollouts());
}

// A residual of a user's own, on two frames' velocities.
class SpeedChangeCost : public TrajectoryCost {
 public:
  SpeedChangeCost() : TrajectoryCost(1, {{0, 2}, {0, 5}}) {}

  bool Evaluate(const Trajectory& trajectory, double* residuals,
                std::vector<StateDerivative>* derivatives) const override {
    const Eigen::MatrixXd& v = trajectory.velocities[0];
    residuals[0] = v.col(5).sum() - 2.0 * v.col(2).sum();
    for (const auto& [frame, weight] : {std::pair(5, 1.0), std::pair(2, -2.0)}) {
      if (derivatives == nullptr) break;
      StateDerivative d;
      d.frame = frame;
      d.d_position.resize(1, v.rows());
      d.d_velocity = (weight * Eigen::RowVectorXd::Ones(v.rows())).eval().sparseView();
      derivatives->push_back(d);
    }
    return true;
  }
};

TEST(TrajectoryProblemCostTest, TakesCostsOnSeveralFramesAndOnVelocities) {
  const Scene scene = SceneWithEverythingEstimated("side");
  for (const JacobianMethod method :
       {JacobianMethod::kTangent, JacobianMethod::kAdjoint}) {
    TrajectoryCosts costs = CostsFor(scene);
    costs.push_back(std::make_unique<SpeedChangeCost>());
    TrajectoryEvaluatorOptions options;
    options.jacobian = method;
    TrajectoryProblem problem(scene, std::move(costs), options);
    const Eigen::VectorXd q = StartOf(scene, problem.evaluator());
    const Eigen::VectorXd direction =
        test::RandomVector(static_cast<int>(q.size()), 10);
    const Eigen::VectorXd analytic = CeresJacobianTimes(&problem, q, direction);
    const auto check = test::CheckDirectionalDerivative(
        [&](const Eigen::VectorXd& x) {
          return Eigen::VectorXd(CeresResiduals(&problem, x).tail<1>());
        },
        q, direction, analytic.tail<1>());
    EXPECT_LT(check.relative_error, 1e-6) << check;
  }
}

TEST(TrajectoryProblemCostTest, RefusesCostsOnObjectsThatAreNotSimulated) {
  Scene scene = test::MakeDerivativeScene("two_objects", 3);
  ApplySettings("nn,nL", &scene);
  TrajectoryCosts costs;
  costs.push_back(std::make_unique<SpeedChangeCost>());
  EXPECT_THROW(TrajectoryProblem(scene, std::move(costs)), SceneError);
}

}  // namespace
}  // namespace dpe
