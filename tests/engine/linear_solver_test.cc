// The linear solvers against dense ones, on well-behaved, non-symmetric, indefinite and
// singular matrices.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <random>

#include "dpe/engine/sensitivity.h"
#include "engine/matrix_support.h"
#include "linear/block_pattern.h"
#include "linear/block_solver.h"
#include "linear/iterative_solver.h"
#include "linear/multiply_many.h"
#include "linear/step_solver.h"
#include "support/derivative_checker.h"

namespace dpe::test {
namespace {

constexpr int kNodes = 40;

struct SolverCase {
  std::string name;
  double skew;
  double shift;
};

class StepSolverTest : public testing::TestWithParam<SolverCase> {};

TEST_P(StepSolverTest, SolvesBothWaysToRoundingLevel) {
  const BlockPattern pattern = RingPattern(kNodes);
  StepSolver solver(std::make_shared<StepSolverContext>(pattern));
  Fill(pattern, GetParam().skew, GetParam().shift, &solver.values());
  const Eigen::MatrixXd a = Dense(pattern, solver.values());
  const Eigen::VectorXd b = RandomVector(pattern.num_rows(), 1);
  ASSERT_TRUE(solver.Factorize(GetParam().skew == 0.0));
  for (const bool transposed : {false, true}) {
    const Eigen::MatrixXd op = transposed ? Eigen::MatrixXd(a.transpose()) : a;
    Eigen::VectorXd z(b.size());
    ASSERT_TRUE(solver.Solve(b.data(), z.data(), transposed));
    EXPECT_LT((op * z - b).norm(), 1e-12 * b.norm());
    const Eigen::VectorXd exact = op.fullPivLu().solve(b);
    EXPECT_LT((z - exact).norm(), 1e-9 * exact.norm());
    Eigen::VectorXd in_place = b;
    ASSERT_TRUE(solver.Solve(in_place.data(), in_place.data(), transposed));
    EXPECT_EQ(in_place, z);
  }
  Eigen::VectorXd zero = Eigen::VectorXd::Zero(b.size());
  ASSERT_TRUE(solver.Solve(zero.data(), zero.data(), false));
  EXPECT_EQ(zero.norm(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Matrices, StepSolverTest,
                         testing::Values(SolverCase{"symmetric", 0.0, 20.0},
                                         SolverCase{"slightly_skew", 0.05, 20.0},
                                         SolverCase{"very_skew", 3.0, 20.0},
                                         SolverCase{"indefinite_symmetric", 0.0, 0.5},
                                         SolverCase{"indefinite_skew", 0.5, 0.5}),
                         [](const auto& info) { return info.param.name; });

TEST(StepSolverTest, SingularAndNonFiniteMatricesAreReported) {
  const BlockPattern pattern = RingPattern(kNodes);
  StepSolver solver(std::make_shared<StepSolverContext>(pattern));
  std::fill(solver.values().begin(), solver.values().end(), 0.0);
  EXPECT_FALSE(solver.Factorize(true));
  Eigen::VectorXd z = RandomVector(pattern.num_rows(), 1);
  for (const bool symmetric : {true, false}) {
    Fill(pattern, 0.0, 20.0, &solver.values());
    solver.values()[0] = std::nan("");
    EXPECT_FALSE(solver.Factorize(symmetric) &&
                 solver.Solve(z.data(), z.data(), false));
  }
  // And the solver is usable again afterwards.
  Fill(pattern, 0.1, 20.0, &solver.values());
  ASSERT_TRUE(solver.Factorize(false));
  z = RandomVector(pattern.num_rows(), 1);
  ASSERT_TRUE(solver.Solve(z.data(), z.data(), false));
  z[3] = std::nan("");
  EXPECT_FALSE(solver.Solve(z.data(), z.data(), false));
}

TEST(StepSolverTest, AnEarlierFactorizationServesANearbyMatrix) {
  const BlockPattern pattern = RingPattern(kNodes);
  const auto context = std::make_shared<StepSolverContext>(pattern);
  StepSolver solver(context), other(context);
  const Eigen::VectorXd b = RandomVector(pattern.num_rows(), 1);
  Eigen::VectorXd z(b.size());
  for (const double shift : {20.0, 0.5}) {  // by Cholesky, and by LU
    Fill(pattern, 0.0, shift, &solver.values());
    ASSERT_TRUE(solver.Factorize(true));
    // Another solver of the same context does not disturb it.
    Fill(pattern, 0.2, 30.0, &other.values());
    ASSERT_TRUE(other.Factorize(false));
    ASSERT_TRUE(other.Solve(b.data(), z.data(), true));
    Fill(pattern, 0.01, shift + 0.1, &solver.values());
    ASSERT_TRUE(solver.KeepFactorization());
    ASSERT_TRUE(solver.Solve(b.data(), z.data(), false));
    const Eigen::MatrixXd a = Dense(pattern, solver.values());
    EXPECT_LT((a * z - b).norm(), 1e-12 * b.norm());
  }
}

TEST(StepSolverTest, AFactorPutAsideServesItsMatrixAndNearbyOnes) {
  const BlockPattern pattern = RingPattern(kNodes);
  const auto context = std::make_shared<StepSolverContext>(pattern);
  StepSolver solver(context);
  const Eigen::VectorXd b = RandomVector(pattern.num_rows(), 1);
  KeptFactor kept;
  for (const double skew : {0.0, 0.3}) {  // by Cholesky, and by LU
    Fill(pattern, skew, 20.0, &solver.values());
    solver.KeepFactorsIn(&kept);
    EXPECT_TRUE(kept.empty());
    ASSERT_TRUE(solver.Factorize(skew == 0.0));
    solver.KeepFactorsIn(nullptr);
    ASSERT_FALSE(kept.empty());
    Fill(pattern, 0.2, 30.0, &solver.values());  // something else in between
    ASSERT_TRUE(solver.Factorize(false));
    for (const double change : {0.0, 0.1, 1000.0}) {  // the last is not nearby
      Fill(pattern, skew, 20.0 + change, &solver.values());
      solver.UseFactor(&kept, skew == 0.0);
      ASSERT_TRUE(solver.KeepFactorization());
      const Eigen::MatrixXd a = Dense(pattern, solver.values());
      for (const bool transposed : {false, true}) {
        const Eigen::MatrixXd op = transposed ? Eigen::MatrixXd(a.transpose()) : a;
        Eigen::VectorXd z(b.size());
        ASSERT_TRUE(solver.Solve(b.data(), z.data(), transposed));
        EXPECT_LT((op * z - b).norm(), 1e-12 * b.norm());
      }
    }
  }
}

// Where a kept factor solves without its matrix the residual is at rounding level; next
// to a singular matrix, for a right-hand side that excites it, there is no telling.
TEST(StepSolverTest, AKeptFactorSolvesAloneWhereThatIsExact) {
  const BlockPattern pattern = RingPattern(kNodes);
  StepSolver solver(std::make_shared<StepSolverContext>(pattern));
  Fill(pattern, 0.0, 20.0, &solver.values());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
      Dense(pattern, solver.values()));
  const Eigen::VectorXd softest = eigen.eigenvectors().col(0);
  const double shift = 20.0 - eigen.eigenvalues()[0];
  Eigen::VectorXd easy = RandomVector(pattern.num_rows(), 1);
  easy -= easy.dot(softest) * softest;
  for (const double least : {10.0, 1e-5}) {  // the smallest eigenvalue
    Fill(pattern, 0.0, shift + least, &solver.values());
    const Eigen::MatrixXd a = Dense(pattern, solver.values());
    KeptFactor kept;
    Eigen::VectorXd z(easy.size());
    solver.KeepFactorsIn(&kept);
    ASSERT_TRUE(solver.Factorize(false));
    EXPECT_FALSE(solver.SolveByKept(easy.data(), z.data(), false));  // none is in use
    ASSERT_TRUE(solver.Solve(easy.data(), z.data(), false));
    solver.KeepFactorsIn(nullptr);
    Fill(pattern, 0.2, 30.0, &solver.values());  // no longer the matrix
    solver.UseFactor(&kept, false);
    for (const bool transposed : {false, true}) {
      ASSERT_TRUE(solver.SolveByKept(easy.data(), z.data(), transposed));
      EXPECT_LT((a * z - easy).norm(), 1e-13 * easy.norm());
      EXPECT_EQ(solver.SolveByKept(softest.data(), z.data(), transposed),
                least == 10.0);
    }
    // It was not tried on anything: nothing is known.
    Fill(pattern, 0.0, shift + least, &solver.values());
    solver.KeepFactorsIn(&kept);
    ASSERT_TRUE(solver.Factorize(false));
    solver.KeepFactorsIn(nullptr);
    solver.UseFactor(&kept, false);
    EXPECT_FALSE(solver.SolveByKept(easy.data(), z.data(), false));
  }
}

TEST(IterativeSolverTest, WhereItFailsTheFactorizationTakesOver) {
  const BlockPattern pattern = RingPattern(kNodes);
  const auto context = std::make_shared<StepSolverContext>(pattern);
  context->iterative = true;
  context->tolerance = 1e-4;
  StepSolver solver(context);
  const Eigen::VectorXd b = RandomVector(pattern.num_rows(), 1);
  Eigen::VectorXd z(b.size());
  const auto relative_residual = [&] {
    return (Dense(pattern, solver.values()) * z - b).norm() / b.norm();
  };
  Fill(pattern, 0.0, 20.0, &solver.values());
  ASSERT_TRUE(solver.Factorize(true) && solver.Solve(b.data(), z.data(), false));
  EXPECT_LT(relative_residual(), 1e-4);
  EXPECT_GT(relative_residual(), 1e-12);  // it did iterate
  // Conjugate gradients notice an indefinite matrix.
  Fill(pattern, 0.0, 0.5, &solver.values());
  ASSERT_TRUE(solver.Factorize(true) && solver.Solve(b.data(), z.data(), false));
  EXPECT_LT(relative_residual(), 1e-12);
}

class BlockSolverTest : public testing::TestWithParam<SolverCase> {};

TEST_P(BlockSolverTest, AllColumnsAgreeWithTheMatrix) {
  const BlockPattern pattern = RingPattern(kNodes);
  const auto context = std::make_shared<StepSolverContext>(pattern);
  context->iterative = true;  // which only a few columns are left to
  StepSolver step_solver(context);
  Fill(pattern, GetParam().skew, GetParam().shift, &step_solver.values());
  const Eigen::MatrixXd a = Dense(pattern, step_solver.values());
  for (const int count : {2, 50}) {
    BlockSolver solver(pattern);
    ASSERT_TRUE(solver.Prepare(&step_solver, GetParam().skew == 0.0, count));
    EXPECT_EQ(solver.thread_safe(), count == 50);
    for (const bool transposed : {false, true}) {
      RowMajorMatrix right(pattern.num_rows(), count);
      right.reshaped() = RandomVector(static_cast<int>(right.size()), 5);
      RowMajorMatrix z = right;
      ASSERT_TRUE(solver.Solve(z.data(), count, transposed));
      const Eigen::MatrixXd op = transposed ? Eigen::MatrixXd(a.transpose()) : a;
      const Eigen::MatrixXd product = op * z;
      EXPECT_LT((product - right).norm(), 1e-11 * right.norm());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Matrices, BlockSolverTest,
                         testing::Values(SolverCase{"symmetric", 0.0, 20.0},
                                         SolverCase{"skew", 0.3, 20.0},
                                         SolverCase{"very_skew", 3.0, 20.0}),
                         [](const auto& info) { return info.param.name; });

TEST(BlockPatternTest, ProductsMatchTheDenseMatrix) {
  const BlockPattern pattern = RingPattern(kNodes);
  std::vector<double> values(pattern.num_nonzeros());
  Fill(pattern, 0.7, 3.0, &values);
  const Eigen::MatrixXd a = Dense(pattern, values);
  const Eigen::VectorXd x = RandomVector(pattern.num_rows(), 2);
  Eigen::VectorXd y(x.size());
  pattern.Multiply(values.data(), x.data(), y.data());
  EXPECT_LT((y - a * x).norm(), 1e-13 * y.norm());
  pattern.MultiplyTransposed(values.data(), x.data(), y.data());
  EXPECT_LT((y - a.transpose() * x).norm(), 1e-13 * y.norm());
}

}  // namespace
}  // namespace dpe::test
