// With the right-hand sides as columns of a row-major array X, the array read
// column-major is X^T, so L X = B is X^T L^T = B^T and every step is one of the two
// dense kernels: products with transposed panels, and solves from the right.
#include <algorithm>

#include "linear/dense_kernels.h"
#include "linear/supernodal_solve.h"

namespace dpe {
namespace {

// A triangle T, of L11 or U11^T, that is T(i, j) = values[i row + j column], i >= j,
// with ones on the diagonal if `unit`, and the rows below it.
struct Triangle {
  const double* values;
  long row, column;
  bool unit;
  const double* below;
  long ld;
};

// One supernode's triangle and what the two sweeps do with it; x is the row-major array
// of the supernode's own columns.
class PanelSolve {
 public:
  PanelSolve(const Triangle& triangle, int rows, int columns, int count)
      : kernels_(BestDenseKernels()),
        triangle_(triangle),
        rows_(rows),
        columns_(columns),
        count_(count) {}

  // x := T^{-1} x.
  void Forward(double* x) const {
    for (int begin = 0; begin < columns_; begin += kPanelWidth) {
      const int width = std::min(kPanelWidth, columns_ - begin);
      double* out = x + static_cast<long>(begin) * count_;
      kernels_.subtract_product(false, count_, width, begin, x, count_, At(begin, 0),
                                triangle_.row, triangle_.column, out, count_);
      double block[kPanelWidth * kPanelWidth];
      double inverse[kPanelWidth];
      for (int j = 0; j < width; ++j) {
        for (int i = 0; i < j; ++i) {
          block[i + kPanelWidth * j] = *At(begin + j, begin + i);
        }
        inverse[j] = InversePivot(begin + j);
      }
      kernels_.solve_right(count_, width, block, inverse, out, count_);
    }
  }

  // below := -the rows below times x; `below` is row-major.
  void UpdateBelow(const double* x, double* below) const {
    kernels_.subtract_product(true, count_, rows_ - columns_, columns_, x, count_,
                              triangle_.below, 1, triangle_.ld, below, count_);
  }

  // x -= the transposed rows below times `below`.
  void SubtractFromBelow(const double* below, double* x) const {
    kernels_.subtract_product(false, count_, columns_, rows_ - columns_, below, count_,
                              triangle_.below, triangle_.ld, 1, x, count_);
  }

  // x := T^{-T} x, last rows first: a solve from the right with the columns reversed.
  void Backward(double* x) const {
    for (int end = columns_; end > 0; end -= std::min(kPanelWidth, end)) {
      const int width = std::min(kPanelWidth, end);
      const int begin = end - width;
      double* out = x + static_cast<long>(begin) * count_;
      kernels_.subtract_product(
          false, count_, width, columns_ - end, x + static_cast<long>(end) * count_,
          count_, At(end, begin), triangle_.column, triangle_.row, out, count_);
      double block[kPanelWidth * kPanelWidth];
      double inverse[kPanelWidth];
      for (int j = 0; j < width; ++j) {
        for (int i = 0; i < j; ++i) {
          block[i + kPanelWidth * j] = *At(end - 1 - i, end - 1 - j);
        }
        inverse[j] = InversePivot(end - 1 - j);
      }
      kernels_.solve_right(count_, width, block, inverse,
                           out + static_cast<long>(width - 1) * count_, -count_);
    }
  }

 private:
  const double* At(int i, int j) const {
    return triangle_.values + i * triangle_.row + j * triangle_.column;
  }
  double InversePivot(int i) const { return triangle_.unit ? 1.0 : 1.0 / *At(i, i); }

  const DenseKernels& kernels_;
  Triangle triangle_;
  int rows_, columns_, count_;
};

// x := D^{-1} x for the own columns of supernode s, of a symmetric matrix.
void DivideByPivots(const SupernodalFactor& factor, int s, int count, double* x) {
  const long rows = factor.row_start[s + 1] - factor.row_start[s];
  const int columns = factor.first_column[s + 1] - factor.first_column[s];
  const double* pivot = factor.lower + factor.value_start[s];
  for (int j = 0; j < columns; ++j, pivot += rows + 1, x += count) {
    const double inverse = 1.0 / *pivot;
    for (int c = 0; c < count; ++c) x[c] *= inverse;
  }
}

}  // namespace

void SolveSupernodalMany(const SupernodalFactor& factor, int count,
                         std::vector<double>* work, double* x) {
  const bool symmetric = factor.upper == nullptr;
  const auto panel = [&](bool of_upper, int s) {
    const int rows = factor.row_start[s + 1] - factor.row_start[s];
    const int columns = factor.first_column[s + 1] - factor.first_column[s];
    const double* lower = factor.lower + factor.value_start[s];
    const Triangle triangle =
        of_upper ? Triangle{lower,
                            rows,
                            1,
                            false,
                            factor.upper + factor.upper_start[s],
                            rows - columns}
                 : Triangle{lower, 1, rows, true, lower + columns, rows};
    return PanelSolve(triangle, rows, columns, count);
  };
  const auto row_of = [&](int row) { return x + static_cast<long>(row) * count; };
  for (int s = 0; s < factor.num_supernodes; ++s) {
    const int columns = factor.first_column[s + 1] - factor.first_column[s];
    const int begin = factor.row_start[s] + columns, end = factor.row_start[s + 1];
    double* own = row_of(factor.first_column[s]);
    const PanelSolve lower = panel(factor.is_transposed && !symmetric, s);
    lower.Forward(own);
    work->resize(static_cast<size_t>(end - begin) * count);
    if (begin < end) lower.UpdateBelow(own, work->data());
    if (symmetric) DivideByPivots(factor, s, count, own);
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
    const PanelSolve upper = panel(!factor.is_transposed && !symmetric, s);
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
