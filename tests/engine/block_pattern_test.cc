// Products with a matrix in block storage, for columns of every small number of blocks.
#include "linear/block_pattern.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "support/derivative_checker.h"

namespace dpe::test {
namespace {

// Node i is coupled to the i nodes before it among the first `num_nodes`, so that
// columns have from 1 (a last node that nothing is coupled to) to num_nodes blocks.
BlockPattern Staircase(int num_nodes) {
  std::vector<std::pair<int, int>> couplings;
  for (int i = 0; i < num_nodes; ++i) {
    for (int j = num_nodes - 1 - i; j < i; ++j) couplings.emplace_back(i, j);
  }
  return BlockPattern(num_nodes + 1, couplings);
}

class BlockProductTest : public testing::TestWithParam<int> {};

TEST_P(BlockProductTest, MatchesTheDenseMatrix) {
  const BlockPattern pattern = Staircase(GetParam());
  const Eigen::VectorXd values = RandomVector(pattern.num_nonzeros(), 1);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(pattern.num_rows(), pattern.num_rows());
  for (int c = 0; c < pattern.num_rows(); ++c) {
    for (int k = pattern.column_starts()[c]; k < pattern.column_starts()[c + 1]; ++k) {
      dense(pattern.row_indices()[k], c) = values[k];
    }
  }
  const Eigen::VectorXd x = RandomVector(pattern.num_rows(), 2);
  Eigen::VectorXd y = RandomVector(pattern.num_rows(), 3);
  pattern.Multiply(values.data(), x.data(), y.data());
  EXPECT_LT((y - dense * x).norm(), 1e-14 * values.norm() * x.norm());
  y = RandomVector(pattern.num_rows(), 3);
  pattern.MultiplyTransposed(values.data(), x.data(), y.data());
  EXPECT_LT((y - dense.transpose() * x).norm(), 1e-14 * values.norm() * x.norm());
}

INSTANTIATE_TEST_SUITE_P(Nodes, BlockProductTest, testing::Values(0, 1, 2, 3, 7, 20));

}  // namespace
}  // namespace dpe::test
