// Fits to several rollouts at once: derivatives across segments, links between them,
// and what the two together say of the parameters.
#include <gtest/gtest.h>

#include <memory>
#include <tuple>

#include "ceres_support.h"
#include "dpe/estimation/trajectory_problem.h"
#include "segment_support.h"
#include "support/derivative_checker.h"

namespace dpe {
namespace {

using test::CeresJacobian;
using test::CeresJacobianTimes;
using test::CeresResiduals;
using test::Dense;

constexpr int kFrames = 6;

std::vector<Scene> ScenesWithEverythingEstimated(ParameterMode mode) {
  std::vector<Scene> scenes = test::SideAndCorners();
  for (Scene& scene : scenes) test::EstimateEverything(mode, &scene);
  return scenes;
}

Eigen::VectorXd StartOf(const std::vector<Scene>& scenes,
                        const TrajectoryEvaluator& evaluator) {
  std::vector<const Scene*> pointers;
  for (const Scene& scene : scenes) pointers.push_back(&scene);
  return evaluator.map().ToCoordinates(evaluator.joint_layout().Extract(pointers));
}

using Case = std::tuple<ParameterMode, JacobianMethod, bool>;

class SegmentsTest : public ::testing::TestWithParam<Case> {};

TEST_P(SegmentsTest, JacobianAndGradientAgreeWithDifferences) {
  const auto [mode, method, own_wind] = GetParam();
  const std::vector<Scene> scenes = ScenesWithEverythingEstimated(mode);
  TrajectoryEvaluatorOptions options;
  options.jacobian = method;
  options.own_wind = own_wind;
  TrajectoryProblem problem(test::SegmentsOf(scenes, kFrames), {}, options);
  TrajectoryEvaluator& evaluator = *problem.evaluator();
  EXPECT_EQ(evaluator.num_frames(0), kFrames);
  EXPECT_EQ(evaluator.num_frames(1), kFrames + 1);
  const Eigen::VectorXd q = StartOf(scenes, evaluator);
  const Eigen::MatrixXd jacobian =
      Dense(CeresJacobian(&problem, problem.least_squares(), q));
  // Block by block, so that no large one hides a small one.
  for (const ParameterBlock& block : problem.layout().blocks()) {
    SCOPED_TRACE(ParameterKindName(block.kind) + " of segment " +
                 std::to_string(block.segment));
    Eigen::VectorXd direction = Eigen::VectorXd::Zero(q.size());
    direction.segment(block.offset, block.size) = test::RandomVector(block.size, 9);
    const auto check = test::CheckDirectionalDerivative(
        [&](const Eigen::VectorXd& x) { return CeresResiduals(&problem, x); }, q,
        direction, jacobian * direction);
    EXPECT_LT(check.relative_error, 1e-6) << check;
    EXPECT_GT(check.norm, 0.0);
  }
  ASSERT_TRUE(evaluator.Evaluate(q) && evaluator.EvaluateJacobian());
  EXPECT_EQ(Eigen::MatrixXd(evaluator.DenseJacobian()), jacobian);
  const Eigen::VectorXd squares = jacobian.colwise().squaredNorm();
  EXPECT_LT((evaluator.JacobianColumnSquares() - squares).norm(),
            1e-13 * squares.norm());
  Eigen::VectorXd gradient;
  ASSERT_TRUE(evaluator.EvaluateGradient(&gradient));
  const Eigen::VectorXd expected = jacobian.transpose() * evaluator.residuals();
  EXPECT_LT((gradient - expected).norm(), 1e-10 * expected.norm());
}

INSTANTIATE_TEST_SUITE_P(ModesAndMethods, SegmentsTest,
                         ::testing::Combine(::testing::Values(ParameterMode::kGlobal,
                                                              ParameterMode::kGroup,
                                                              ParameterMode::kLocal),
                                            ::testing::Values(JacobianMethod::kTangent,
                                                              JacobianMethod::kAdjoint),
                                            ::testing::Bool()));

TEST(SegmentsEvaluator, OneSegmentIsThePlainProblem) {
  const Scene scene = ScenesWithEverythingEstimated(ParameterMode::kLocal)[1];
  std::vector<TrajectorySegment> segments = test::SegmentsOf({scene}, kFrames);
  TrajectoryEvaluator plain(scene,
                            std::move(test::SegmentsOf({scene}, kFrames)[0].costs));
  TrajectoryEvaluator evaluator(std::move(segments));
  const Eigen::VectorXd q = StartOf({scene}, evaluator);
  ASSERT_TRUE(plain.Evaluate(q) && plain.EvaluateJacobian());
  ASSERT_TRUE(evaluator.Evaluate(q) && evaluator.EvaluateJacobian());
  EXPECT_EQ(plain.residuals(), evaluator.residuals());
  EXPECT_EQ(plain.jacobian(), evaluator.jacobian());
  EXPECT_EQ(RowMajorMatrix(evaluator.DenseJacobian()), plain.jacobian());
}

TEST(SegmentsEvaluator, CostIsTheSumOfThatOfEachAlone) {
  const std::vector<Scene> scenes =
      ScenesWithEverythingEstimated(ParameterMode::kLocal);
  TrajectoryEvaluatorOptions options;
  options.own_wind = true;  // they differ
  TrajectoryEvaluator both(test::SegmentsOf(scenes, kFrames), {}, options);
  const Eigen::VectorXd q = StartOf(scenes, both);
  ASSERT_TRUE(both.Evaluate(q));
  double sum = 0.0, short_sum = 0.0;
  for (const Scene& scene : scenes) {
    std::vector<TrajectorySegment> segments = test::SegmentsOf(scenes, kFrames);
    const int s = &scene == &scenes[0] ? 0 : 1;
    TrajectoryEvaluator alone(scene, std::move(segments[s].costs));
    const Eigen::VectorXd own = StartOf({scene}, alone);
    ASSERT_TRUE(alone.Evaluate(own));
    sum += alone.cost();
    double part = 0.0;
    ASSERT_TRUE(alone.CostOverHorizon(own, 3, &part));
    short_sum += part;
  }
  EXPECT_NEAR(both.cost(), sum, 1e-12 * sum);
  double horizon = 0.0;
  ASSERT_TRUE(both.CostOverHorizon(q, 3, &horizon));
  EXPECT_NEAR(horizon, short_sum, 1e-12 * short_sum);
  EXPECT_LT(horizon, sum);
}

TEST(SegmentsEvaluator, ResultsDoNotDependOnTheNumberOfThreads) {
  std::vector<Scene> scenes = ScenesWithEverythingEstimated(ParameterMode::kLocal);
  scenes.push_back(scenes[0]);
  for (const JacobianMethod method :
       {JacobianMethod::kTangent, JacobianMethod::kAdjoint}) {
    Eigen::VectorXd residuals, gradient;
    RowMajorMatrix jacobian;
    for (const int num_threads : {1, 2, 3, 7}) {
      TrajectoryEvaluatorOptions options;
      options.jacobian = method;
      options.num_threads = num_threads;
      TrajectoryEvaluator evaluator(test::SegmentsOf(scenes, kFrames), {{0, 4, 1}},
                                    options);
      const Eigen::VectorXd q = StartOf(scenes, evaluator);
      Eigen::VectorXd g;
      ASSERT_TRUE(evaluator.Evaluate(q) && evaluator.EvaluateJacobian() &&
                  evaluator.EvaluateGradient(&g));
      if (num_threads == 1) {
        residuals = evaluator.residuals();
        jacobian = evaluator.DenseJacobian();
        gradient = g;
      }
      EXPECT_EQ(evaluator.residuals(), residuals) << num_threads;
      EXPECT_EQ(evaluator.DenseJacobian(), jacobian) << num_threads;
      EXPECT_EQ(g, gradient) << num_threads;
    }
  }
}

TEST(SegmentsEvaluator, AFailureNamesItsSegment) {
  std::vector<Scene> scenes = test::SideAndCorners();
  for (Scene& scene : scenes) ApplySettings("nG", &scene);
  scenes[1].integration_method = IntegrationMethod::kExplicitEuler;
  TrajectoryEvaluator evaluator(test::SegmentsOf(scenes, 12));
  EXPECT_FALSE(evaluator.Evaluate(Eigen::VectorXd::Constant(1, std::log(1e9))));
  EXPECT_EQ(evaluator.message().rfind("segment 1: ", 0), 0) << evaluator.message();
  EXPECT_TRUE(evaluator.Evaluate(Eigen::VectorXd::Constant(1, std::log(1.0))));
}

// Links: the residuals' value, their derivative, and what Ceres and L-BFGS see of them.
class SegmentLinkTest : public ::testing::Test {
 protected:
  SegmentLinkTest() : scenes_(ScenesWithEverythingEstimated(ParameterMode::kLocal)) {
    scenes_[1] = scenes_[0];
    scenes_[1].objects[0].velocities.array() += 0.1;
    scenes_[1].objects[0].positions.array() += 0.05;
    scenes_.push_back(scenes_[1]);
    problem_ = std::make_unique<TrajectoryProblem>(
        test::SegmentsOf(scenes_, kFrames),
        std::vector<SegmentLink>{{0, 5, 1, 2.0, 0.3}, {1, 3, 2, 7.0, 0.5}});
    q_ = StartOf(scenes_, *problem_->evaluator());
  }

  std::vector<Scene> scenes_;
  std::unique_ptr<TrajectoryProblem> problem_;
  Eigen::VectorXd q_;
};

TEST_F(SegmentLinkTest, ResidualsAreWeightedJumps) {
  TrajectoryEvaluator& evaluator = *problem_->evaluator();
  ASSERT_TRUE(evaluator.Evaluate(q_));
  const int cost = kFrames - 1;  // after the position costs of the first segment
  ASSERT_EQ(evaluator.LinkTarget(cost), 1);
  ASSERT_EQ(evaluator.LinkTarget(0), -1);
  const Eigen::VectorXd rows = evaluator.residuals().segment(
      evaluator.first_row(cost), evaluator.costs()[cost]->num_residuals());
  const Eigen::VectorXd& x1 = scenes_[1].objects[0].positions;
  const Eigen::VectorXd& v1 = scenes_[1].objects[0].velocities;
  const Eigen::VectorXd jump_x = evaluator.trajectory(0).positions[0].col(5) - x1;
  const Eigen::VectorXd jump_v = evaluator.trajectory(0).velocities[0].col(5) - v1;
  const int n = 36;  // coordinates of free vertices, which come first
  ASSERT_EQ(rows.size(), 2 * n);
  // The layout has velocities before positions.
  EXPECT_LT((rows.head(n) - 0.3 * jump_v.head(n)).norm(), 1e-13);
  EXPECT_LT((rows.tail(n) - 2.0 * jump_x.head(n)).norm(), 1e-13);
  EXPECT_GT(jump_v.head(n).norm(), 0.1);
  evaluator.SetLinkWeights(0, 20.0, 3.0);
  ASSERT_TRUE(evaluator.Evaluate(q_));
  EXPECT_LT(
      (evaluator.residuals().segment(evaluator.first_row(cost), 2 * n) - 10.0 * rows)
          .norm(),
      1e-12 * rows.norm());
}

TEST_F(SegmentLinkTest, DerivativesAgreeWithDifferences) {
  const Eigen::VectorXd direction = test::RandomVector(static_cast<int>(q_.size()), 4);
  const int row = problem_->evaluator()->first_row(kFrames - 1);
  const auto links = [&](const Eigen::VectorXd& all) {
    return Eigen::VectorXd(all.segment(row, 72));
  };
  const auto check = test::CheckDirectionalDerivative(
      [&](const Eigen::VectorXd& x) {
        return links(CeresResiduals(problem_.get(), x));
      },
      q_, direction, links(CeresJacobianTimes(problem_.get(), q_, direction)));
  EXPECT_LT(check.relative_error, 1e-7) << check;
  const Eigen::MatrixXd jacobian =
      Dense(CeresJacobian(problem_.get(), problem_->least_squares(), q_));
  TrajectoryEvaluator& evaluator = *problem_->evaluator();
  ASSERT_TRUE(evaluator.Evaluate(q_) && evaluator.EvaluateJacobian());
  EXPECT_EQ(Eigen::MatrixXd(evaluator.DenseJacobian()), jacobian);
  Eigen::VectorXd gradient;
  ASSERT_TRUE(evaluator.EvaluateGradient(&gradient));
  const Eigen::VectorXd expected = jacobian.transpose() * evaluator.residuals();
  EXPECT_LT((gradient - expected).norm(), 1e-10 * expected.norm());
}

TEST_F(SegmentLinkTest, ReducedProblemKeepsCostGradientAndZeros) {
  const Eigen::MatrixXd full =
      Dense(CeresJacobian(problem_.get(), problem_->least_squares(), q_));
  const Eigen::VectorXd residuals = CeresResiduals(problem_.get(), q_);
  const auto reduced = problem_->NewReducedLeastSquares();
  ASSERT_NE(reduced, nullptr);
  // Costs of three segments, and two links.
  EXPECT_EQ(reduced->NumResidualBlocks(), 5);
  const ceres::CRSMatrix sparse = CeresJacobian(problem_.get(), reduced.get(), q_);
  const Eigen::MatrixXd r = Dense(sparse);
  const Eigen::MatrixXd gram = full.transpose() * full;
  EXPECT_LT((r.transpose() * r - gram).norm(), 1e-13 * gram.norm());
  EXPECT_LT(static_cast<double>(sparse.values.size()), 0.7 * full.size());
  double cost = 0.0;
  std::vector<double> gradient;
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = test::ParameterBlocksOf(problem_.get(), *reduced);
  ASSERT_TRUE(reduced->Evaluate(options, &cost, nullptr, &gradient, nullptr));
  EXPECT_NEAR(cost, 0.5 * residuals.squaredNorm(), 1e-14 * cost);
  const Eigen::VectorXd expected = full.transpose() * residuals;
  EXPECT_LT(
      (Eigen::Map<Eigen::VectorXd>(gradient.data(), gradient.size()) - expected).norm(),
      1e-12 * expected.norm());
  for (const int num_threads : {1, 2}) {  // Ceres's own threads
    ceres::Problem::EvaluateOptions threaded = options;
    threaded.num_threads = num_threads;
    double again = 0.0;
    ASSERT_TRUE(reduced->Evaluate(threaded, &again, nullptr, &gradient, nullptr));
    EXPECT_NEAR(again, cost, 1e-14 * cost);  // the order of a sum
  }
}

TEST_F(SegmentLinkTest, LinksThatDoNotFitAreRefused) {
  for (const SegmentLink& link : {SegmentLink{0, 2, 0}, SegmentLink{0, 2, 3},
                                  SegmentLink{-1, 2, 0}, SegmentLink{0, -2, 1}}) {
    EXPECT_THROW(TrajectoryEvaluator(test::SegmentsOf(scenes_, kFrames), {link}),
                 SceneError);
  }
  std::vector<Scene> scenes = test::SideAndCorners();
  for (Scene& scene : scenes) ApplySettings("nG", &scene);
  EXPECT_THROW(TrajectoryEvaluator(test::SegmentsOf(scenes, kFrames), {{0, 2, 1}}),
               SceneError);
}

}  // namespace
}  // namespace dpe
