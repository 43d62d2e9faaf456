// Sparse LU and its triangular solves against dense ones, and the dense kernels of
// every instruction set against plain sums.
#include "linear/supernodal_lu.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "dpe/engine/sensitivity.h"
#include "engine/matrix_support.h"
#include "linear/dense_kernels.h"
#include "linear/direct_solver.h"
#include "linear/symbolic_analysis.h"
#include "support/derivative_checker.h"

namespace dpe::test {
namespace {

struct LuCase {
  const char* name;
  BlockPattern pattern;
};

std::vector<LuCase> LuCases() {
  BlockPattern apart(30, {{0, 1}, {1, 2}, {5, 9}, {20, 25}});
  return {{"one_node", BlockPattern(1, {})},
          {"disconnected", apart},
          {"ring", RingPattern(40)},
          {"strip", GridPattern(3, 40)},
          {"grid", GridPattern(17, 19)}};
}

class SupernodalLuTest : public testing::TestWithParam<LuCase> {};

// With a small shift the symmetric part is indefinite, and not so with a large one.
TEST_P(SupernodalLuTest, SolvesBothWaysForOneAndForManyRightHandSides) {
  const BlockPattern& pattern = GetParam().pattern;
  SupernodalLu lu(AnalyzePattern(pattern));
  std::vector<double> values(pattern.num_nonzeros()), work;
  for (const double skew : {0.5, 0.0, 0.3}) {  // after the first in used panels
    Fill(pattern, skew, 40.0, &values);
    ASSERT_TRUE(lu.Factorize(values.data(), /*symmetric=*/skew == 0.0, &work));
    const Eigen::MatrixXd a = Dense(pattern, values);
    for (const bool transposed : {false, true}) {
      const Eigen::MatrixXd op = transposed ? Eigen::MatrixXd(a.transpose()) : a;
      const SupernodalFactor factor =
          transposed ? lu.factor().Transposed() : lu.factor();
      const Eigen::VectorXd b = RandomVector(pattern.num_rows(), 1);
      Eigen::VectorXd z = b;
      SolveSupernodal(factor, &work, z.data());
      EXPECT_LT((op * z - b).norm(), 1e-13 * b.norm());
      for (const int count : {1, 7, 33}) {
        RowMajorMatrix right(pattern.num_rows(), count);
        right.reshaped() = RandomVector(static_cast<int>(right.size()), 5);
        RowMajorMatrix many = right;
        SolveSupernodalMany(factor, count, &work, many.data());
        EXPECT_LT((op * many - right).norm(), 1e-13 * right.norm());
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Patterns, SupernodalLuTest, testing::ValuesIn(LuCases()),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(SupernodalLuTest, ReportsPivotsThatAreNotThere) {
  const BlockPattern pattern = GridPattern(6, 6);
  SupernodalLu lu(AnalyzePattern(pattern));
  std::vector<double> values(pattern.num_nonzeros()), work;
  EXPECT_FALSE(lu.Factorize(values.data(), /*symmetric=*/false, &work));  // all zeros
  Fill(pattern, 0.5, 30.0, &values);
  values[pattern.Find(20, 20).offset] = std::nan("");
  EXPECT_FALSE(lu.Factorize(values.data(), /*symmetric=*/false, &work));
  Fill(pattern, 0.5, 30.0, &values);
  EXPECT_TRUE(lu.Factorize(values.data(), /*symmetric=*/false, &work));
}

// [0 1; 1 0] in every block row: well-conditioned, but elimination in order fails.
TEST(DirectSolverTest, AMatrixThatNeedsPivotsIsSolvedWithPivots) {
  const BlockPattern pattern = GridPattern(5, 5);
  DirectSolver solver(std::make_shared<DirectSolverContext>(pattern));
  std::vector<double> values(pattern.num_nonzeros());
  Fill(pattern, 0.5, 0.0, &values);
  for (int i = 0; i < pattern.num_nodes(); ++i) {
    const BlockSlot slot = pattern.Find(i, i);
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r) {
        values[slot.offset + c * slot.stride + r] = c + r == 2 && c != r ? 40.0 : 0.0;
      }
    }
    values[slot.offset + slot.stride + 1] = 40.0;
  }
  ASSERT_TRUE(solver.Factorize(values, /*symmetric=*/false));
  const Eigen::MatrixXd a = Dense(pattern, values);
  const Eigen::VectorXd b = RandomVector(pattern.num_rows(), 1);
  Eigen::VectorXd z(b.size());
  ASSERT_TRUE(solver.Solve(values, b.data(), z.data(), /*transposed=*/true));
  EXPECT_LT((a.transpose() * z - b).norm(), 1e-12 * b.norm());
  // Such factors are not handed out as exact ones.
  EXPECT_EQ(solver.ExactFactor(values).lower, nullptr);
}

struct KernelCase {
  const char* name;
  const DenseKernels* kernels;
  const char* feature;
};

bool IsUsable(const KernelCase& c) {
  if (c.kernels == nullptr) return false;
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (std::string(c.feature) == "avx512") return __builtin_cpu_supports("avx512f");
  if (std::string(c.feature) == "avx2") {
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  }
#endif
  return true;
}

class DenseKernelsTest : public testing::TestWithParam<KernelCase> {};

TEST_P(DenseKernelsTest, ProductsOfAllShapes) {
  if (!IsUsable(GetParam())) GTEST_SKIP() << "not on this processor";
  for (const int m : {1, 2, 7, 24, 25, 40, 47}) {
    for (const int n : {1, 3, 5, 8, 14}) {
      for (const int k : {0, 1, 9, 300}) {
        const Eigen::MatrixXd a = RandomVector((m + 2) * k, 1).reshaped(m + 2, k);
        const Eigen::MatrixXd b = RandomVector((n + 1) * k, 2).reshaped(n + 1, k);
        const Eigen::MatrixXd b_rows = b.transpose();
        const Eigen::MatrixXd c = RandomVector((m + 3) * n, 3).reshaped(m + 3, n);
        const Eigen::MatrixXd product = a.topRows(m) * b.topRows(n).transpose();
        for (const bool overwrite : {false, true}) {
          Eigen::MatrixXd expected = c;
          if (overwrite) expected.topRows(m).setZero();
          expected.topRows(m) -= product;
          Eigen::MatrixXd out = c;
          GetParam().kernels->subtract_product(overwrite, m, n, k, a.data(), m + 2,
                                               b.data(), 1, n + 1, out.data(), m + 3);
          EXPECT_LT((out - expected).norm(), 1e-13 * (expected.norm() + k));
          out = c;  // b given by rows
          GetParam().kernels->subtract_product(overwrite, m, n, k, a.data(), m + 2,
                                               b_rows.data(), k, 1, out.data(), m + 3);
          EXPECT_LT((out - expected).norm(), 1e-13 * (expected.norm() + k));
          EXPECT_EQ(out.bottomRows(3), c.bottomRows(3)) << "wrote below the rows";
        }
      }
    }
  }
}

TEST_P(DenseKernelsTest, SolvesFromTheRight) {
  if (!IsUsable(GetParam())) GTEST_SKIP() << "not on this processor";
  const Eigen::MatrixXd triangle = RandomVector(64, 1).reshaped(8, 8);
  const Eigen::VectorXd scale = RandomVector(8, 2).array() + 3.0;
  for (const int m : {1, 5, 8, 19}) {
    for (const int width : {1, 3, 8}) {
      const Eigen::MatrixXd x = RandomVector((m + 1) * width, 3).reshaped(m + 1, width);
      Eigen::MatrixXd t = triangle.topLeftCorner(width, width);
      t.triangularView<Eigen::StrictlyLower>().setZero();
      t.diagonal() = scale.head(width).cwiseInverse();
      Eigen::MatrixXd out = x;
      GetParam().kernels->solve_right(m, width, triangle.data(), scale.data(),
                                      out.data(), m + 1);
      EXPECT_LT((out.topRows(m) * t - x.topRows(m)).norm(), 1e-12 * out.norm());
      EXPECT_EQ(out.bottomRows(1), x.bottomRows(1));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    InstructionSets, DenseKernelsTest,
    testing::Values(KernelCase{"avx512", DenseKernelsAvx512(), "avx512"},
                    KernelCase{"avx2", DenseKernelsAvx2(), "avx2"},
                    KernelCase{"generic", DenseKernelsGeneric(), ""}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace dpe::test
