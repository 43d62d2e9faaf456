// Matrices in a BlockPattern for the tests of linear solvers.
#ifndef DPE_TESTS_ENGINE_MATRIX_SUPPORT_H_
#define DPE_TESTS_ENGINE_MATRIX_SUPPORT_H_

#include <Eigen/Core>
#include <random>
#include <utility>
#include <vector>

#include "linear/block_pattern.h"
#include "linear/ordering.h"

namespace dpe::test {

// A ring of nodes with a few chords.
inline BlockPattern RingPattern(int num_nodes) {
  std::vector<std::pair<int, int>> couplings = {{-1, 2}};  // fixed vertices are skipped
  for (int i = 0; i < num_nodes; ++i) {
    couplings.emplace_back(i, (i + 1) % num_nodes);
    couplings.emplace_back((i + 1) % num_nodes, i);
    couplings.emplace_back(i, (i + 5) % num_nodes);
  }
  return BlockPattern(num_nodes, couplings);
}

inline Eigen::MatrixXd Dense(const BlockPattern& pattern,
                             const std::vector<double>& values) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(pattern.num_rows(), pattern.num_rows());
  for (int j = 0; j < pattern.num_rows(); ++j) {
    for (int k = pattern.column_starts()[j]; k < pattern.column_starts()[j + 1]; ++k) {
      a(pattern.row_indices()[k], j) = values[k];
    }
  }
  return a;
}

// Random blocks; `skew` scales the non-symmetric part, `shift` the diagonal.
inline void Fill(const BlockPattern& pattern, double skew, double shift,
                 std::vector<double>* values) {
  std::mt19937 generator(4);
  std::normal_distribution<double> normal;
  std::fill(values->begin(), values->end(), 0.0);
  for (int j = 0; j < pattern.num_nodes(); ++j) {
    for (int k = pattern.block_starts()[j]; k < pattern.block_starts()[j + 1]; ++k) {
      const int i = pattern.block_rows()[k];
      Eigen::Matrix3d block;
      for (double& entry : block.reshaped()) entry = normal(generator);
      Eigen::Matrix3d perturbation;
      for (double& entry : perturbation.reshaped()) entry = normal(generator);
      if (i > j) continue;  // the upper triangle decides
      if (i == j) {
        block =
            (block + block.transpose()).eval() + shift * Eigen::Matrix3d::Identity();
      }
      AddBlock(pattern.Find(i, j), block + skew * perturbation, values->data());
      if (i < j) AddBlock(pattern.Find(j, i), block.transpose(), values->data());
    }
  }
}

// A rows x columns grid of nodes, each coupled to the eight around it, numbered in
// fill-reducing order.
inline BlockPattern GridPattern(int rows, int columns) {
  std::vector<std::pair<int, int>> couplings;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const int node = i * columns + j;
      if (i + 1 < rows) couplings.emplace_back(node, node + columns);
      if (j + 1 < columns) couplings.emplace_back(node, node + 1);
      if (i + 1 < rows && j + 1 < columns) {
        couplings.emplace_back(node, node + columns + 1);
        couplings.emplace_back(node + 1, node + columns);
      }
    }
  }
  const std::vector<int> order = FillReducingOrder(rows * columns, couplings);
  std::vector<int> number(order.size());
  for (size_t k = 0; k < order.size(); ++k) number[order[k]] = static_cast<int>(k);
  for (auto& [a, b] : couplings) {
    a = number[a];
    b = number[b];
  }
  return BlockPattern(rows * columns, couplings);
}

}  // namespace dpe::test

#endif  // DPE_TESTS_ENGINE_MATRIX_SUPPORT_H_
