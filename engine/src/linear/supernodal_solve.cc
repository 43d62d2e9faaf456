#include "linear/supernodal_solve.h"

#include <algorithm>

#include "linear/vectorize.h"

namespace dpe {
namespace {

constexpr int kWidth = 4;  // columns that a sweep over the rows takes along

// Some columns of a panel; the last one stands for those that are missing.
struct Columns {
  Columns(const double* values, long ld, int count) {
    for (int k = 0; k < kWidth; ++k) at[k] = values + std::min(k, count - 1) * ld;
  }
  const double* at[kWidth];
};

// y[0, rows) -= the columns times x.
inline void Subtract(const Columns& c, const double* x, int begin, int end,
                     double* __restrict y) {
  for (int i = begin; i < end; ++i) {
    y[i] -=
        c.at[0][i] * x[0] + c.at[1][i] * x[1] + c.at[2][i] * x[2] + c.at[3][i] * x[3];
  }
}

// sum[k] += column k . y
inline void AddDots(const Columns& c, const double* y, int begin, int end,
                    double* sum) {
  double s0 = 0.0, s1 = 0.0, s2 = 0.0, s3 = 0.0;
#pragma omp simd reduction(+ : s0, s1, s2, s3)
  for (int i = begin; i < end; ++i) {
    s0 += c.at[0][i] * y[i];
    s1 += c.at[1][i] * y[i];
    s2 += c.at[2][i] * y[i];
    s3 += c.at[3][i] * y[i];
  }
  sum[0] += s0;
  sum[1] += s1;
  sum[2] += s2;
  sum[3] += s3;
}

// In these t[0, columns) belongs to a supernode's own columns and is solved for; the
// rows below follow. `lower` is the panel of L with U11 above the diagonal, `upper`
// that of U12^T.

// t := [L11 0; L21 I]^{-1} t.
DPE_VECTORIZE
void ForwardLower(const double* lower, int rows, int columns, double* __restrict t) {
  for (int j = 0; j < columns; j += kWidth) {
    const int width = std::min(kWidth, columns - j);
    const Columns l(lower + static_cast<long>(j) * rows, rows, width);
    double x[kWidth] = {};
    for (int k = 0; k < width; ++k) {
      x[k] = t[j + k];
      for (int m = 0; m < k; ++m) x[k] -= l.at[m][j + k] * x[m];
      t[j + k] = x[k];
    }
    Subtract(l, x, j + width, rows, t);
  }
}

// t := [U11^T 0; U12^T I]^{-1} t.
DPE_VECTORIZE
void ForwardUpper(const double* lower, const double* upper, int rows, int columns,
                  double* __restrict t) {
  const int below = rows - columns;
  for (int j = 0; j < columns; j += kWidth) {
    const int width = std::min(kWidth, columns - j);
    const Columns u(lower + static_cast<long>(j) * rows, rows, width);
    double sum[kWidth] = {}, x[kWidth] = {};
    AddDots(u, t, 0, j, sum);
    for (int k = 0; k < width; ++k) {
      x[k] = t[j + k] - sum[k];
      for (int m = 0; m < k; ++m) x[k] -= u.at[k][j + m] * x[m];
      x[k] /= u.at[k][j + k];
      t[j + k] = x[k];
    }
    Subtract(Columns(upper + static_cast<long>(j) * below, below, width), x, 0, below,
             t + columns);
  }
}

// t[0, columns) := U11^{-1} (t - U12 t_below).
DPE_VECTORIZE
void BackwardUpper(const double* lower, const double* upper, int rows, int columns,
                   double* __restrict t) {
  const int below = rows - columns;
  for (int end = columns; end > 0; end -= std::min(kWidth, end)) {
    const int width = std::min(kWidth, end), j = end - width;
    const Columns u(lower + static_cast<long>(j) * rows, rows, width);
    double sum[kWidth] = {}, x[kWidth] = {};
    AddDots(Columns(upper + static_cast<long>(j) * below, below, width), t + columns, 0,
            below, sum);
    for (int k = width - 1; k >= 0; --k) {
      x[k] = t[j + k] - sum[k];
      for (int m = k + 1; m < width; ++m) x[k] -= u.at[m][j + k] * x[m];
      x[k] /= u.at[k][j + k];
      t[j + k] = x[k];
    }
    Subtract(u, x, 0, j, t);
  }
}

// t[0, columns) := L11^{-T} (t - L21^T t_below).
DPE_VECTORIZE
void BackwardLower(const double* lower, int rows, int columns, double* __restrict t) {
  for (int end = columns; end > 0; end -= std::min(kWidth, end)) {
    const int width = std::min(kWidth, end), j = end - width;
    const Columns l(lower + static_cast<long>(j) * rows, rows, width);
    double sum[kWidth] = {};
    AddDots(l, t, end, rows, sum);
    for (int k = width - 1; k >= 0; --k) {
      double x = t[j + k] - sum[k];
      for (int m = k + 1; m < width; ++m) x -= l.at[k][j + m] * t[j + m];
      t[j + k] = x;
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
    const double* lower = factor.lower + factor.value_start[s];
    work->resize(rows);
    double* t = work->data();
    std::copy_n(x + first, columns, t);
    std::fill(t + columns, t + rows, 0.0);
    if (factor.upper == nullptr) {
      ForwardLower(lower, rows, columns, t);
    } else if (factor.is_transposed) {
      ForwardUpper(lower, factor.upper + factor.upper_start[s], rows, columns, t);
    } else {
      ForwardLower(lower, rows, columns, t);
    }
    if (factor.upper == nullptr) {
      for (int i = 0; i < columns; ++i) x[first + i] = t[i] / lower[i + long{i} * rows];
    } else {
      std::copy_n(t, columns, x + first);
    }
    for (int i = columns; i < rows; ++i) x[row[i]] += t[i];
  }
  for (int s = factor.num_supernodes - 1; s >= 0; --s) {
    const int first = factor.first_column[s];
    const int columns = factor.first_column[s + 1] - first;
    const int rows = factor.row_start[s + 1] - factor.row_start[s];
    const int* row = factor.row_indices + factor.row_start[s];
    const double* lower = factor.lower + factor.value_start[s];
    work->resize(rows);
    double* t = work->data();
    std::copy_n(x + first, columns, t);
    for (int i = columns; i < rows; ++i) t[i] = x[row[i]];
    if (factor.is_transposed || factor.upper == nullptr) {
      BackwardLower(lower, rows, columns, t);
    } else {
      BackwardUpper(lower, factor.upper + factor.upper_start[s], rows, columns, t);
    }
    std::copy_n(t, columns, x + first);
  }
}

}  // namespace dpe
