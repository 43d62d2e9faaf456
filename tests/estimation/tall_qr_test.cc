#include "tall_qr.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <Eigen/SVD>
#include <atomic>
#include <chrono>
#include <cmath>
#include <random>
#include <thread>
#include <vector>

namespace dpe {
namespace {

Eigen::MatrixXd RandomMatrix(int rows, int cols, int seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, cols, [&] { return normal(generator); });
}

// The rows of `a` in chunks of the given sizes; what is left over is one more.
Eigen::MatrixXd TriangleOf(const Eigen::MatrixXd& a, std::vector<int> chunk_rows,
                           int num_threads = 1) {
  std::vector<int> first(1, 0);
  for (const int rows : chunk_rows) first.push_back(first.back() + rows);
  if (first.back() < a.rows()) {
    chunk_rows.push_back(static_cast<int>(a.rows()) - first.back());
  }
  Eigen::MatrixXd r;
  EXPECT_TRUE(TallQr(
      chunk_rows, static_cast<int>(a.cols()), num_threads,
      [&](int chunk, Eigen::Ref<Eigen::MatrixXd> rows) {
        rows = a.middleRows(first[chunk], chunk_rows[chunk]);
        return true;
      },
      &r));
  return r;
}

// The largest error of R^T R, each entry relative to the lengths of its two columns.
double GramError(const Eigen::MatrixXd& a, const Eigen::MatrixXd& r) {
  const Eigen::VectorXd lengths =
      a.colwise().norm().transpose().array().max(1e-300).matrix();
  const Eigen::MatrixXd error = r.transpose() * r - a.transpose() * a;
  return (error.array() / (lengths * lengths.transpose()).array()).abs().maxCoeff();
}

bool IsUpperTriangular(const Eigen::MatrixXd& r) {
  for (int j = 0; j < r.cols(); ++j) {
    if ((r.col(j).tail(r.rows() - 1 - j).array() != 0.0).any()) return false;
  }
  return true;
}

TEST(TallQrTest, TheTriangleHasTheGramMatrixOfAllRows) {
  const Eigen::MatrixXd a = RandomMatrix(1000, 37, 1);
  for (const std::vector<int>& chunks :
       {std::vector<int>{}, {1, 2, 3, 500}, {400, 400}, std::vector<int>(100, 10)}) {
    const Eigen::MatrixXd r = TriangleOf(a, chunks);
    ASSERT_EQ(r.rows(), 37);
    EXPECT_TRUE(IsUpperTriangular(r));
    EXPECT_LT(GramError(a, r), 1e-14) << chunks.size();
  }
}

TEST(TallQrTest, OneColumn) {
  const Eigen::MatrixXd a = RandomMatrix(100, 1, 2);
  const Eigen::MatrixXd r = TriangleOf(a, {30, 30});
  EXPECT_NEAR(std::abs(r(0, 0)), a.norm(), 1e-14 * a.norm());
}

TEST(TallQrTest, ColumnsKeepTheirOwnAccuracy) {
  Eigen::MatrixXd a = RandomMatrix(800, 12, 3);
  for (int j = 0; j < 12; ++j) a.col(j) *= std::pow(10.0, 3 * (j % 7) - 9);
  EXPECT_LT(GramError(a, TriangleOf(a, std::vector<int>(10, 64))), 1e-14);
}

// Through A^T A a singular value of 1e-11 times the largest would be lost.
TEST(TallQrTest, DoesNotSquareTheConditionNumber) {
  const int n = 20;
  Eigen::VectorXd singular(n);
  for (int i = 0; i < n; ++i) singular[i] = std::pow(10.0, -11.0 * i / (n - 1));
  const Eigen::MatrixXd u =
      Eigen::HouseholderQR<Eigen::MatrixXd>(RandomMatrix(600, n, 4)).householderQ() *
      Eigen::MatrixXd::Identity(600, n);
  const Eigen::MatrixXd v =
      Eigen::HouseholderQR<Eigen::MatrixXd>(RandomMatrix(n, n, 5)).householderQ();
  const Eigen::MatrixXd r =
      TriangleOf(u * singular.asDiagonal() * v.transpose(), std::vector<int>(9, 60));
  const Eigen::VectorXd found = Eigen::JacobiSVD<Eigen::MatrixXd>(r).singularValues();
  EXPECT_NEAR(found[n - 1], singular[n - 1], 1e-3 * singular[n - 1]);
}

TEST(TallQrTest, FewerRowsThanColumnsDependentColumnsAndZeros) {
  const Eigen::MatrixXd wide = RandomMatrix(5, 9, 6);
  EXPECT_LT(GramError(wide, TriangleOf(wide, {2, 2})), 1e-14);
  Eigen::MatrixXd dependent = RandomMatrix(300, 6, 7);
  dependent.col(3) = 2.0 * dependent.col(0) - dependent.col(5);
  dependent.col(4).setZero();
  const Eigen::MatrixXd r = TriangleOf(dependent, {100, 100});
  EXPECT_LT(GramError(dependent, r), 1e-14);
  EXPECT_EQ(r.col(4).norm(), 0.0);
  EXPECT_EQ(TriangleOf(Eigen::MatrixXd::Zero(50, 4), {}).norm(), 0.0);
  EXPECT_EQ(TriangleOf(Eigen::MatrixXd(0, 4), {}), Eigen::MatrixXd::Zero(4, 4));
}

TEST(TallQrTest, DoesNotDependOnTheNumberOfThreads) {
  const Eigen::MatrixXd a = RandomMatrix(3000, 40, 8);
  for (const int num_chunks : {3, 29, 30}) {
    const std::vector<int> chunks(num_chunks, 3000 / num_chunks);
    const Eigen::MatrixXd one = TriangleOf(a, chunks, 1);
    EXPECT_LT(GramError(a, one), 1e-14);
    for (const int num_threads : {2, 3, 16}) {
      EXPECT_EQ(TriangleOf(a, chunks, num_threads), one) << num_threads;
    }
  }
}

TEST(TallQrTest, ChunksAreFilledOnceEachAndByOneThreadAtATime) {
  std::vector<std::atomic<int>> calls(64);
  std::atomic<int> inside{0};
  std::atomic<bool> overlapped{false};
  Eigen::MatrixXd r;
  EXPECT_TRUE(TallQr(
      std::vector<int>(64, 20), 8, 4,
      [&](int chunk, Eigen::Ref<Eigen::MatrixXd> rows) {
        if (++inside != 1) overlapped = true;
        ++calls[chunk];
        rows.setConstant(chunk);
        // Time for another thread to come in, if it can.
        std::this_thread::sleep_for(std::chrono::microseconds(200));
        --inside;
        return true;
      },
      &r));
  EXPECT_FALSE(overlapped);
  for (const std::atomic<int>& count : calls) EXPECT_EQ(count, 1);
}

TEST(TallQrTest, GivesUpWhenAChunkCannotBeFilled) {
  for (const int num_threads : {1, 4}) {
    std::atomic<int> calls{0};
    Eigen::MatrixXd r;
    EXPECT_FALSE(TallQr(
        std::vector<int>(64, 20), 8, num_threads,
        [&](int, Eigen::Ref<Eigen::MatrixXd> rows) {
          rows.setOnes();
          return ++calls < 10;
        },
        &r));
    EXPECT_EQ(calls, 10);
  }
}

}  // namespace
}  // namespace dpe
