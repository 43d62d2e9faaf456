#include "linear/supernodal_solve.h"

#include <algorithm>

#include "linear/vectorize.h"

namespace dpe {
namespace {

constexpr int kWidth = 4;  // columns that a sweep over the rows takes along

// t := the solution with the dense columns of one supernode: t[0, columns) is solved
// with the triangle, the rows below are lowered by its product.
DPE_VECTORIZE
void ForwardDense(const double* values, int rows, int columns, double* __restrict t) {
  for (int j = 0; j < columns; j += kWidth) {
    const int width = std::min(kWidth, columns - j);
    const double* l[kWidth];
    double x[kWidth] = {};
    for (int k = 0; k < kWidth; ++k) {
      l[k] = values + static_cast<long>(j + std::min(k, width - 1)) * rows;
    }
    for (int k = 0; k < width; ++k) {
      x[k] = t[j + k];
      for (int m = 0; m < k; ++m) x[k] -= l[m][j + k] * x[m];
      x[k] /= l[k][j + k];
      t[j + k] = x[k];
    }
    for (int i = j + width; i < rows; ++i) {
      t[i] -= l[0][i] * x[0] + l[1][i] * x[1] + l[2][i] * x[2] + l[3][i] * x[3];
    }
  }
}

// The same with the transposed columns: t[0, columns) is solved, given the rows below.
DPE_VECTORIZE
void BackwardDense(const double* values, int rows, int columns, double* __restrict t) {
  for (int end = columns; end > 0; end -= std::min(kWidth, end)) {
    const int width = std::min(kWidth, end);
    const int j = end - width;
    const double* l[kWidth];
    for (int k = 0; k < kWidth; ++k) {
      l[k] = values + static_cast<long>(j + std::min(k, width - 1)) * rows;
    }
    double s0 = 0.0, s1 = 0.0, s2 = 0.0, s3 = 0.0;
#pragma omp simd reduction(+ : s0, s1, s2, s3)
    for (int i = end; i < rows; ++i) {
      s0 += l[0][i] * t[i];
      s1 += l[1][i] * t[i];
      s2 += l[2][i] * t[i];
      s3 += l[3][i] * t[i];
    }
    const double sum[kWidth] = {s0, s1, s2, s3};
    for (int k = width - 1; k >= 0; --k) {
      double x = t[j + k] - sum[k];
      for (int m = k + 1; m < width; ++m) x -= l[k][j + m] * t[j + m];
      t[j + k] = x / l[k][j + k];
    }
  }
}

}  // namespace

void SolveSupernodal(const SupernodalFactor& factor, std::vector<double>* work,
                     double* x) {
  for (int s = 0; s < factor.num_supernodes; ++s) {
    const int first = factor.first_column[s];
    const int columns = factor.first_column[s + 1] - first;
    const int rows = factor.row_start[s + 1] - factor.row_start[s];
    const int* row = factor.row_indices + factor.row_start[s];
    work->resize(rows);
    double* t = work->data();
    std::copy_n(x + first, columns, t);
    std::fill(t + columns, t + rows, 0.0);
    ForwardDense(factor.lower + factor.value_start[s], rows, columns, t);
    std::copy_n(t, columns, x + first);
    for (int i = columns; i < rows; ++i) x[row[i]] += t[i];
  }
  for (int s = factor.num_supernodes - 1; s >= 0; --s) {
    const int first = factor.first_column[s];
    const int columns = factor.first_column[s + 1] - first;
    const int rows = factor.row_start[s + 1] - factor.row_start[s];
    const int* row = factor.row_indices + factor.row_start[s];
    work->resize(rows);
    double* t = work->data();
    std::copy_n(x + first, columns, t);
    for (int i = columns; i < rows; ++i) t[i] = x[row[i]];
    BackwardDense(factor.upper + factor.value_start[s], rows, columns, t);
    std::copy_n(t, columns, x + first);
  }
}

}  // namespace dpe
