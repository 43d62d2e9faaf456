// With the right-hand sides as columns of a row-major array X, the array read
// column-major is X^T, so L X = B is X^T L^T = B^T and every step is one of the two
// dense kernels: products with transposed panels, and solves from the right.
#include <algorithm>

#include "linear/dense_kernels.h"
#include "linear/supernodal_solve.h"

namespace dpe {
namespace {

// One supernode's panel and what the two sweeps do with it; x is the row-major array of
// the supernode's own columns.
class PanelSolve {
 public:
  PanelSolve(const double* values, int rows, int columns, int count)
      : kernels_(BestDenseKernels()),
        values_(values),
        rows_(rows),
        columns_(columns),
        count_(count) {}

  // x := L11^{-1} x.
  void Forward(double* x) const {
    for (int begin = 0; begin < columns_; begin += kPanelWidth) {
      const int width = std::min(kPanelWidth, columns_ - begin);
      double* out = x + static_cast<long>(begin) * count_;
      kernels_.subtract_product(false, count_, width, begin, x, count_, values_ + begin,
                                1, rows_, out, count_);
      double triangle[kPanelWidth * kPanelWidth];
      double inverse[kPanelWidth];
      for (int j = 0; j < width; ++j) {
        for (int i = 0; i < j; ++i) {
          triangle[i + kPanelWidth * j] = At(begin + j, begin + i);
        }
        inverse[j] = 1.0 / At(begin + j, begin + j);
      }
      kernels_.solve_right(count_, width, triangle, inverse, out, count_);
    }
  }

  // below := -L21 x; `below` is row-major.
  void UpdateBelow(const double* x, double* below) const {
    kernels_.subtract_product(true, count_, rows_ - columns_, columns_, x, count_,
                              values_ + columns_, 1, rows_, below, count_);
  }

  // x -= U12 below.
  void SubtractFromBelow(const double* below, double* x) const {
    kernels_.subtract_product(false, count_, columns_, rows_ - columns_, below, count_,
                              values_ + columns_, rows_, 1, x, count_);
  }

  // x := U11^{-1} x, last rows first: a solve from the right with the columns reversed.
  void Backward(double* x) const {
    for (int end = columns_; end > 0; end -= std::min(kPanelWidth, end)) {
      const int width = std::min(kPanelWidth, end);
      const int begin = end - width;
      double* out = x + static_cast<long>(begin) * count_;
      kernels_.subtract_product(false, count_, width, columns_ - end,
                                x + static_cast<long>(end) * count_, count_,
                                values_ + end + begin * rows_, rows_, 1, out, count_);
      double triangle[kPanelWidth * kPanelWidth];
      double inverse[kPanelWidth];
      for (int j = 0; j < width; ++j) {
        for (int i = 0; i < j; ++i) {
          triangle[i + kPanelWidth * j] = At(end - 1 - i, end - 1 - j);
        }
        inverse[j] = 1.0 / At(end - 1 - j, end - 1 - j);
      }
      kernels_.solve_right(count_, width, triangle, inverse,
                           out + static_cast<long>(width - 1) * count_, -count_);
    }
  }

 private:
  double At(int i, int j) const { return values_[i + j * rows_]; }

  const DenseKernels& kernels_;
  const double* values_;
  long rows_;
  int columns_, count_;
};

}  // namespace

void SolveSupernodalMany(const SupernodalFactor& factor, int count,
                         std::vector<double>* work, double* x) {
  const auto panel = [&](const double* values, int s) {
    return PanelSolve(values + factor.value_start[s],
                      factor.row_start[s + 1] - factor.row_start[s],
                      factor.first_column[s + 1] - factor.first_column[s], count);
  };
  const auto row_of = [&](int row) { return x + static_cast<long>(row) * count; };
  for (int s = 0; s < factor.num_supernodes; ++s) {
    const int columns = factor.first_column[s + 1] - factor.first_column[s];
    const int begin = factor.row_start[s] + columns, end = factor.row_start[s + 1];
    double* own = row_of(factor.first_column[s]);
    const PanelSolve lower = panel(factor.lower, s);
    lower.Forward(own);
    if (begin == end) continue;
    work->resize(static_cast<size_t>(end - begin) * count);
    lower.UpdateBelow(own, work->data());
    const double* in = work->data();
    for (int k = begin; k < end; ++k, in += count) {
      double* out = row_of(factor.row_indices[k]);
      for (int c = 0; c < count; ++c) out[c] += in[c];
    }
  }
  for (int s = factor.num_supernodes - 1; s >= 0; --s) {
    const int columns = factor.first_column[s + 1] - factor.first_column[s];
    const int begin = factor.row_start[s] + columns, end = factor.row_start[s + 1];
    double* own = row_of(factor.first_column[s]);
    const PanelSolve upper = panel(factor.upper, s);
    if (begin < end) {
      work->resize(static_cast<size_t>(end - begin) * count);
      double* out = work->data();
      for (int k = begin; k < end; ++k, out += count) {
        std::copy_n(row_of(factor.row_indices[k]), count, out);
      }
      upper.SubtractFromBelow(work->data(), own);
    }
    upper.Backward(own);
  }
}

}  // namespace dpe
