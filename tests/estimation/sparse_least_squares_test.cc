#include "sparse_least_squares.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "support/derivative_checker.h"

namespace dpe {
namespace {

// A 40 x 6 matrix with about half of its entries, columns of very different lengths.
Eigen::MatrixXd TestMatrix() {
  Eigen::MatrixXd matrix(40, 6);
  const Eigen::VectorXd random = test::RandomVector(240, 11);
  for (int i = 0; i < 240; ++i) {
    matrix(i % 40, i / 40) = random[i] > 0.0 ? random[i] : 0.0;
  }
  for (int j = 0; j < 6; ++j) matrix.col(j) *= std::pow(10.0, 2 * j - 6);
  return matrix;
}

TEST(SparseLeastSquaresTest, AgreesWithDenseQr) {
  const Eigen::MatrixXd matrix = TestMatrix();
  const Eigen::VectorXd rhs = test::RandomVector(40, 12);
  const SparseLeastSquares solver(matrix.sparseView());
  ASSERT_TRUE(solver.ok());
  EXPECT_EQ(solver.num_dead(), 0);
  const Eigen::VectorXd expected = matrix.colPivHouseholderQr().solve(rhs);
  const Eigen::VectorXd x = solver.Solve(rhs);
  EXPECT_LT(((x - expected).array() / expected.array()).abs().maxCoeff(), 1e-11);
}

TEST(SparseLeastSquaresTest, NamesTheColumnsThatAreNotDetermined) {
  Eigen::MatrixXd matrix = TestMatrix();
  matrix.col(2).setZero();
  matrix.col(5) = 3.0 * matrix.col(1);
  const Eigen::VectorXd truth =
      (Eigen::VectorXd(6) << 1.0, 2.0, 0.0, 4.0, 5.0, 0.0).finished();
  const SparseLeastSquares solver(matrix.sparseView());
  EXPECT_EQ(solver.num_dead(), 2);
  EXPECT_TRUE(solver.is_dead(2));
  EXPECT_NE(solver.is_dead(1), solver.is_dead(5));
  const Eigen::VectorXd x = solver.Solve(matrix * truth);
  EXPECT_EQ(x[2], 0.0);
  // The right-hand side is of the order of 1e3 and column 1 of 1e-4: rounding of the
  // former alone moves this unknown by about 1e-9.
  EXPECT_NEAR(x[1] + 3.0 * x[5], 2.0, 1e-8);
  EXPECT_NEAR(x[4], 5.0, 1e-10);
  EXPECT_LT((matrix * (x - truth)).norm(), 1e-12 * (matrix * truth).norm());
}

TEST(SparseLeastSquaresTest, NothingToSolveIsNoError) {
  const SparseLeastSquares solver(Eigen::SparseMatrix<double>(5, 3));
  ASSERT_TRUE(solver.ok());
  EXPECT_EQ(solver.num_dead(), 3);
  EXPECT_EQ(solver.Solve(Eigen::VectorXd::Ones(5)), Eigen::VectorXd::Zero(3));
}

}  // namespace
}  // namespace dpe
