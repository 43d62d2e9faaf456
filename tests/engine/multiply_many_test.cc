// Products of a block matrix with many vectors at once, against dense ones.
#include "linear/multiply_many.h"

#include <gtest/gtest.h>

#include <random>

#include "dpe/engine/sensitivity.h"
#include "linear/vector_kernels.h"
#include "support/derivative_checker.h"

namespace dpe::test {
namespace {

constexpr int kNodes = 9;

// A chain with a few long couplings; some nodes have an odd, others an even number.
BlockPattern MakePattern() {
  std::vector<std::pair<int, int>> couplings = {{0, 4}, {2, 8}, {1, 6}, {0, 8}};
  for (int i = 0; i + 1 < kNodes; ++i) couplings.emplace_back(i, i + 1);
  return {kNodes, couplings};
}

// Random values, but zero in every third block.
std::vector<double> MakeValues(const BlockPattern& pattern) {
  std::mt19937 generator(4);
  std::normal_distribution<double> normal;
  std::vector<double> values(pattern.num_nonzeros());
  int block = 0;
  for (int j = 0; j < kNodes; ++j) {
    for (int k = pattern.block_starts()[j]; k < pattern.block_starts()[j + 1]; ++k) {
      if (block++ % 3 == 1) continue;
      const BlockSlot slot = pattern.Find(pattern.block_rows()[k], j);
      for (int e = 0; e < 9; ++e) {
        values[slot.offset + e / 3 * slot.stride + e % 3] = normal(generator);
      }
    }
  }
  return values;
}

Eigen::MatrixXd Dense(const BlockPattern& pattern, const std::vector<double>& values) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(pattern.num_rows(), pattern.num_rows());
  for (int j = 0; j < pattern.num_rows(); ++j) {
    for (int k = pattern.column_starts()[j]; k < pattern.column_starts()[j + 1]; ++k) {
      a(pattern.row_indices()[k], j) = values[k];
    }
  }
  return a;
}

RowMajorMatrix RandomMatrix(int rows, int columns, unsigned seed) {
  RowMajorMatrix matrix(rows, columns);
  matrix.reshaped() = RandomVector(rows * columns, seed);
  return matrix;
}

TEST(MultiplyManyTest, MatchesTheDenseProduct) {
  const BlockPattern pattern = MakePattern();
  const std::vector<double> values = MakeValues(pattern);
  const int n = pattern.num_rows();
  BlockRows rows;  // taken up again, as passes do
  for (const bool transposed : {false, true}) {
    rows.Assign(pattern, values.data(), transposed);
    Eigen::MatrixXd a = Dense(pattern, values);
    if (transposed) a.transposeInPlace();
    for (const int count : {1, 7, 8, 33, 96}) {
      const RowMajorMatrix in = RandomMatrix(n, count, 6);
      const RowMajorMatrix base = RandomMatrix(n, count, 7);
      const auto expect_near = [&](const RowMajorMatrix& out, double scale) {
        const Eigen::MatrixXd expected = a * in + scale * base;
        EXPECT_LT((out - expected).norm(), 1e-14 * expected.norm()) << count;
      };
      RowMajorMatrix out = RandomMatrix(n, count, 8);  // is overwritten
      rows.Multiply(in.data(), count, 0.0, nullptr, out.data());
      expect_near(out, 0.0);
      rows.Multiply(in.data(), count, -0.3, base.data(), out.data());
      expect_near(out, -0.3);
      for (const double scale : {1.0, 0.7}) {
        out = base;
        rows.Multiply(in.data(), count, scale, out.data(), out.data());
        expect_near(out, scale);
      }
    }
  }
}

TEST(MultiplyManyTest, ANumberThatIsNotFiniteIsNoZeroBlock) {
  const BlockPattern pattern(1, {});
  std::vector<double> values(9, 0.0);
  values[4] = std::numeric_limits<double>::quiet_NaN();
  BlockRows rows;
  rows.Assign(pattern, values.data(), /*transposed=*/false);
  const double in[3] = {1.0, 1.0, 1.0};
  double out[3];
  rows.Multiply(in, 1, 0.0, nullptr, out);
  EXPECT_TRUE(std::isnan(out[1]));
}

TEST(MultiplyManyTest, SumsOfVectors) {
  const Eigen::VectorXd x = RandomVector(37, 1), y = RandomVector(37, 2);
  Eigen::VectorXd z = x;
  AddScaled(z.size(), 0.3, y.data(), z.data());
  EXPECT_LT((z - (x + 0.3 * y)).norm(), 1e-15 * z.norm());
  Combine(z.size(), 2.0, x.data(), -0.5, y.data(), z.data());
  EXPECT_LT((z - (2.0 * x - 0.5 * y)).norm(), 1e-15 * z.norm());
}

}  // namespace
}  // namespace dpe::test
