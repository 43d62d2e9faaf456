#include "reduced_problem.h"

#include <ceres/ceres.h>
#include <ceres/normal_prior.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "dpe/engine/simulator.h"
#include "dpe/estimation/trajectory_problem.h"
#include "fit_support.h"
#include "relative_step_manifold.h"
#include "support/derivative_checker.h"
#include "support/test_scenes.h"

namespace dpe {
namespace {

// Residuals sin(A x) - b, over two parameter blocks, one function per row block.
class SineCost : public ceres::CostFunction {
 public:
  SineCost(int rows, int first_size, int second_size, int seed)
      : a_(rows, first_size + second_size), b_(test::RandomVector(rows, seed)) {
    const Eigen::VectorXd values =
        test::RandomVector(static_cast<int>(a_.size()), seed + 1);
    a_ = Eigen::Map<const Eigen::MatrixXd>(values.data(), a_.rows(), a_.cols());
    set_num_residuals(rows);
    *mutable_parameter_block_sizes() = {first_size, second_size};
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const std::vector<int>& sizes = parameter_block_sizes();
    Eigen::VectorXd x(sizes[0] + sizes[1]);
    x << Eigen::Map<const Eigen::VectorXd>(parameters[0], sizes[0]),
        Eigen::Map<const Eigen::VectorXd>(parameters[1], sizes[1]);
    const Eigen::VectorXd phase = a_ * x;
    Eigen::Map<Eigen::VectorXd>(residuals, b_.size()) =
        phase.array().sin() - b_.array();
    const Eigen::MatrixXd j = phase.array().cos().matrix().asDiagonal() * a_;
    for (int k = 0; jacobians != nullptr && k < 2; ++k) {
      if (jacobians[k] == nullptr) continue;
      Eigen::Map<RowMajorMatrix>(jacobians[k], b_.size(), sizes[k]) =
          j.middleCols(k == 0 ? 0 : sizes[0], sizes[k]);
    }
    return true;
  }

 private:
  Eigen::MatrixXd a_;
  Eigen::VectorXd b_;
};

struct Evaluation {
  double cost = 0.0;
  double cost_alone = 0.0;  // without asking for derivatives
  Eigen::VectorXd gradient;
  Eigen::MatrixXd gram;  // J^T J
  int num_rows = 0;
};

Evaluation Evaluate(ceres::Problem* problem, const std::vector<double*>& blocks) {
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = blocks;
  Evaluation e;
  std::vector<double> gradient;
  ceres::CRSMatrix j;
  EXPECT_TRUE(problem->Evaluate(options, &e.cost_alone, nullptr, nullptr, nullptr));
  EXPECT_TRUE(problem->Evaluate(options, &e.cost, nullptr, &gradient, &j));
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(j.num_rows, j.num_cols);
  for (int row = 0; row < j.num_rows; ++row) {
    for (int k = j.rows[row]; k < j.rows[row + 1]; ++k) {
      dense(row, j.cols[k]) = j.values[k];
    }
  }
  e.gram = dense.transpose() * dense;
  e.gradient = Eigen::Map<Eigen::VectorXd>(gradient.data(), gradient.size());
  e.num_rows = j.num_rows;
  return e;
}

void ExpectSame(const Evaluation& full, const Evaluation& reduced) {
  EXPECT_NEAR(reduced.cost, full.cost, 4e-16 * full.cost);
  EXPECT_NEAR(reduced.cost_alone, full.cost, 4e-16 * full.cost);
  ASSERT_EQ(reduced.gradient.size(), full.gradient.size());
  EXPECT_LT((reduced.gradient - full.gradient).norm(), 1e-13 * full.gradient.norm());
  EXPECT_LT((reduced.gram - full.gram).norm(), 1e-13 * full.gram.norm());
  EXPECT_GT(full.gradient.norm(), 0.0);
  EXPECT_EQ(reduced.num_rows, full.gradient.size() + 1);
}

// Three parameter blocks; x and y, x and z share residuals.
class ReducedProblemTest : public ::testing::Test {
 protected:
  void Add(int rows, ceres::LossFunction* loss, std::vector<double>* second, int seed) {
    full_.AddResidualBlock(
        new SineCost(rows, 3, static_cast<int>(second->size()), seed), loss, x_.data(),
        second->data());
  }

  void AddAll() {
    Add(7, nullptr, &y_, 1);
    Add(1, nullptr, &y_, 2);
    Add(9, nullptr, &z_, 3);
  }

  void ExpectReducedIsSame(const std::vector<double*>& blocks) {
    for (const int num_threads : {1, 2}) {
      const auto reduced = NewReducedProblem(&full_, nullptr, num_threads, nullptr);
      ASSERT_NE(reduced, nullptr);
      ExpectSame(Evaluate(&full_, blocks), Evaluate(reduced.get(), blocks));
    }
  }

  std::vector<double> x_ = {0.3, -0.2, 0.5};
  std::vector<double> y_ = {0.1, 0.7};
  std::vector<double> z_ = {-0.4, 0.2, 0.9, -0.6};
  ceres::Problem full_;
};

TEST_F(ReducedProblemTest, HasTheSameCostGradientAndGramMatrix) {
  AddAll();
  ExpectReducedIsSame({x_.data(), y_.data(), z_.data()});
}

TEST_F(ReducedProblemTest, WithLossFunctions) {
  Add(7, new ceres::HuberLoss(0.1), &y_, 1);
  Add(1, new ceres::CauchyLoss(0.2), &y_, 2);
  Add(1, new ceres::SoftLOneLoss(0.5), &y_, 4);
  Add(9, new ceres::TukeyLoss(5.0), &z_, 3);
  Add(5, nullptr, &z_, 5);
  ExpectReducedIsSame({x_.data(), y_.data(), z_.data()});
}

TEST_F(ReducedProblemTest, WithAConstantBlock) {
  AddAll();
  full_.SetParameterBlockConstant(z_.data());
  ExpectReducedIsSame({x_.data(), y_.data()});
}

TEST_F(ReducedProblemTest, WithManifolds) {
  AddAll();
  full_.SetManifold(x_.data(), new ceres::SubsetManifold(3, {1}));
  full_.SetManifold(z_.data(), new ceres::SphereManifold<4>());
  ExpectReducedIsSame({x_.data(), y_.data(), z_.data()});
}

// A block with relative steps becomes several, over the same memory.
TEST_F(ReducedProblemTest, WithABlockInPieces) {
  std::vector<double> w(70);
  for (size_t i = 0; i < w.size(); ++i) w[i] = 0.01 * static_cast<double>(i);
  Add(90, nullptr, &w, 6);
  full_.SetParameterUpperBound(w.data(), 65, 0.9);
  const auto reduced =
      NewReducedProblem(&full_, nullptr, 1, nullptr, nullptr, {w.data(), y_.data()});
  ASSERT_NE(reduced, nullptr);
  ASSERT_EQ(reduced->NumParameterBlocks(), 4);
  EXPECT_EQ(reduced->GetManifold(x_.data()), nullptr);
  EXPECT_NE(reduced->GetManifold(w.data() + 32), nullptr);
  EXPECT_EQ(reduced->ParameterBlockSize(w.data() + 64), 6);
  EXPECT_EQ(reduced->GetParameterUpperBound(w.data() + 64, 1), 0.9);
  ExpectSame(
      Evaluate(&full_, {x_.data(), w.data()}),
      Evaluate(reduced.get(), {x_.data(), w.data(), w.data() + 32, w.data() + 64}));
}

TEST_F(ReducedProblemTest, FollowsThePointAndKeepsBounds) {
  AddAll();
  full_.SetParameterLowerBound(y_.data(), 1, 0.65);
  full_.SetParameterUpperBound(z_.data(), 2, 0.95);
  const auto reduced = NewReducedProblem(&full_, nullptr, 1, nullptr);
  EXPECT_EQ(reduced->GetParameterLowerBound(y_.data(), 1), 0.65);
  EXPECT_EQ(reduced->GetParameterUpperBound(z_.data(), 2), 0.95);
  EXPECT_EQ(reduced->GetParameterLowerBound(y_.data(), 0),
            full_.GetParameterLowerBound(y_.data(), 0));
  x_[0] += 0.1;
  z_[3] -= 0.2;
  const std::vector<double*> blocks = {x_.data(), y_.data(), z_.data()};
  ExpectSame(Evaluate(&full_, blocks), Evaluate(reduced.get(), blocks));
}

TEST_F(ReducedProblemTest, NothingIsGainedWithoutMoreResidualsThanParameters) {
  Add(3, nullptr, &y_, 1);
  EXPECT_EQ(NewReducedProblem(&full_, nullptr, 1, nullptr), nullptr);
  Add(2, nullptr, &y_, 2);  // 5 residuals, 5 parameters
  EXPECT_EQ(NewReducedProblem(&full_, nullptr, 1, nullptr), nullptr);
  Add(1, nullptr, &y_, 3);
  EXPECT_NE(NewReducedProblem(&full_, nullptr, 1, nullptr), nullptr);
  full_.SetParameterBlockConstant(x_.data());
  full_.SetParameterBlockConstant(y_.data());
  EXPECT_EQ(NewReducedProblem(&full_, nullptr, 1, nullptr), nullptr);
}

// Every residual and derivative a given number.
class ConstantCost : public ceres::SizedCostFunction<6, 2> {
 public:
  ConstantCost(double residual, double derivative)
      : residual_(residual), derivative_(derivative) {}

  bool Evaluate(double const* const* /*parameters*/, double* residuals,
                double** jacobians) const override {
    std::fill_n(residuals, 6, residual_);
    if (jacobians != nullptr) std::fill_n(jacobians[0], 12, derivative_);
    return true;
  }

 private:
  double residual_, derivative_;
};

class ReducedProblemLimitsTest : public ::testing::Test {
 protected:
  bool Evaluate(double residual, double derivative, bool with_jacobian, double* cost,
                std::vector<double>* gradient) {
    ceres::Problem full;
    full.AddResidualBlock(new ConstantCost(residual, derivative), nullptr, x_);
    return NewReducedProblem(&full, nullptr, 1, nullptr)
        ->Evaluate({}, cost, nullptr, with_jacobian ? gradient : nullptr, nullptr);
  }

  double x_[2] = {0.0, 0.0};
  double cost_ = -1.0;
  std::vector<double> gradient_;
};

TEST_F(ReducedProblemLimitsTest, NoResidualNoCostNoGradient) {
  ASSERT_TRUE(Evaluate(0.0, 1.0, true, &cost_, &gradient_));
  EXPECT_EQ(cost_, 0.0);
  EXPECT_EQ(gradient_, std::vector<double>(2, 0.0));
}

// Equal columns: J has rank 1, and the residual lies in its range.
TEST_F(ReducedProblemLimitsTest, DependentColumns) {
  ASSERT_TRUE(Evaluate(2.0, 3.0, true, &cost_, &gradient_));
  EXPECT_NEAR(cost_, 12.0, 1e-14);
  EXPECT_NEAR(gradient_[0], 36.0, 1e-13);
  EXPECT_NEAR(gradient_[1], 36.0, 1e-13);
}

TEST_F(ReducedProblemLimitsTest, WhatIsNotFiniteIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity}) {
    EXPECT_TRUE(Evaluate(1.0, bad, false, &cost_, &gradient_));
    EXPECT_FALSE(Evaluate(1.0, bad, true, &cost_, &gradient_));
    EXPECT_FALSE(Evaluate(bad, 1.0, false, &cost_, &gradient_));
    EXPECT_FALSE(Evaluate(bad, 1.0, true, &cost_, &gradient_));
  }
}

// What Levenberg-Marquardt does with one problem and the other.

constexpr int kFrames = 60;

// The scene's own motion as target, and a start some way off.
std::unique_ptr<TrajectoryProblem> NewTrajectoryProblem(
    const char* settings, int num_threads = 1,
    const std::function<bool()>& interrupted = nullptr) {
  Scene scene = test::MakeDerivativeScene("side", 4);
  ApplySettings(settings, &scene);
  TrajectoryEvaluatorOptions options;
  options.num_threads = num_threads;
  options.interrupted = interrupted;
  auto problem = std::make_unique<TrajectoryProblem>(
      scene, MakePositionCosts(scene, test::OwnMotion(scene, kFrames), kFrames),
      options);
  const Eigen::VectorXd truth =
      problem->evaluator()->map().ToCoordinates(problem->layout().Extract(scene));
  problem->set_coordinates(
      truth + 0.3 * test::RandomVector(static_cast<int>(truth.size()), 12));
  return problem;
}

std::vector<double> CostsOfIterations(ceres::Problem* problem) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.min_lm_diagonal = 1e-24;
  options.max_num_iterations = 20;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, problem, &summary);
  std::vector<double> costs;  // of a step that is too long: the largest number
  for (const ceres::IterationSummary& s : summary.iterations) costs.push_back(s.cost);
  return costs;
}

TEST(ReducedTrajectoryProblemTest, LevenbergMarquardtTakesTheSameSteps) {
  const auto full = NewTrajectoryProblem("nL");
  const auto other = NewTrajectoryProblem("nL");
  const auto reduced = other->NewReducedLeastSquares();
  ASSERT_NE(reduced, nullptr);
  // The reduced problem has the relative steps of local blocks; the full one is asked.
  const int size = full->layout().blocks()[0].size;
  ASSERT_GT(size, 32);  // in pieces
  full->least_squares()->SetManifold(full->block_coordinates(0),
                                     new RelativeStepManifold(size));
  const std::vector<double> expected = CostsOfIterations(full->least_squares());
  const std::vector<double> costs = CostsOfIterations(reduced.get());
  ASSERT_EQ(costs.size(), expected.size());
  EXPECT_LT(full->evaluator()->best_cost(), 1e-6 * expected.front());
  for (size_t i = 0; i < costs.size(); ++i) {
    EXPECT_NEAR(costs[i], expected[i], 1e-6 * expected[i]) << i;
  }
  EXPECT_LT((other->coordinates() - full->coordinates()).norm(),
            1e-8 * full->coordinates().norm());
  EXPECT_EQ(other->evaluator()->num_rollouts(), full->evaluator()->num_rollouts());
  EXPECT_EQ(other->evaluator()->num_derivative_passes(),
            full->evaluator()->num_derivative_passes());
}

TEST(ReducedTrajectoryProblemTest, FurtherResidualBlocksAndLossesTakePart) {
  const auto problem = NewTrajectoryProblem("GG");
  problem->least_squares()->AddResidualBlock(
      new ceres::NormalPrior(Eigen::MatrixXd::Constant(1, 1, 0.1),
                             Eigen::VectorXd::Constant(1, 3.0)),
      new ceres::CauchyLoss(0.1), problem->block_coordinates(1));
  const std::vector<double*> blocks = {problem->block_coordinates(0),
                                       problem->block_coordinates(1)};
  ExpectSame(Evaluate(problem->least_squares(), blocks),
             Evaluate(problem->NewReducedLeastSquares().get(), blocks));
}

TEST(ReducedTrajectoryProblemTest, IteratesDoNotDependOnTheNumberOfThreads) {
  const auto one = NewTrajectoryProblem("LL", 1);
  const auto three = NewTrajectoryProblem("LL", 3);
  EXPECT_EQ(CostsOfIterations(one->NewReducedLeastSquares().get()),
            CostsOfIterations(three->NewReducedLeastSquares().get()));
  EXPECT_EQ(one->coordinates(), three->coordinates());
}

TEST(ReducedTrajectoryProblemTest, AnEstimationReportsItsLinearAlgebra) {
  Scene scene = test::MakeDerivativeScene("side", 4);
  ApplySettings("nL", &scene);
  EstimatorOptions options;
  options.init = InitMethod::kUniform;
  options.uniform_value = 20.0;
  options.max_iterations = 3;
  Timings timings;
  options.timings = &timings;
  const EstimatorSummary summary =
      Estimate(scene, test::OwnMotion(scene, kFrames), options);
  // One reduction per Jacobian, one evaluation per further point, and the solver's own.
  EXPECT_GT(timings.Calls(TimedPart::kLeastSquares), summary.jacobian_evaluations);
  EXPECT_GT(timings.Seconds(TimedPart::kLeastSquares), 0.0);
  EXPECT_NE(timings.Table(summary.wall_time_s, "rest").find("least squares"),
            std::string::npos);
}

// Polls of the rollout and its derivatives come first, those of the reduction after.
TEST(ReducedTrajectoryProblemTest, AReductionIsInterruptedBetweenItsPieces) {
  int num_polls = 0, last_poll = 1 << 30;
  const auto evaluate = [&](bool reduce) {
    num_polls = 0;
    const auto problem =
        NewTrajectoryProblem("nL", 1, [&] { return ++num_polls > last_poll; });
    const auto reduced = problem->NewReducedLeastSquares();
    std::vector<double> gradient;
    return (reduce ? reduced.get() : problem->least_squares())
        ->Evaluate({}, nullptr, nullptr, &gradient, nullptr);
  };
  ASSERT_TRUE(evaluate(false));
  const int polls_before = num_polls;
  ASSERT_TRUE(evaluate(true));
  const int num_pieces = num_polls - polls_before;
  EXPECT_GE(num_pieces, 3);
  for (const int pieces : {0, 1, num_pieces - 1}) {
    last_poll = polls_before + pieces;
    EXPECT_FALSE(evaluate(true));
    EXPECT_EQ(num_polls, last_poll + 1);
  }
}

}  // namespace
}  // namespace dpe
