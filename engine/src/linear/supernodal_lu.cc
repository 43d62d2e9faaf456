#include "linear/supernodal_lu.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "linear/dense_kernels.h"

namespace dpe {
namespace {

// A pivot below this fraction of the largest number in its diagonal block is nothing
// but rounding.
constexpr double kMinPivot = 1e-15;

// Remainders of symmetric matrices are made so many columns at a time.
constexpr int kTriangleColumns = 24;

constexpr double kOnes[kPanelWidth] = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0};

// The factors of a diagonal block of up to kPanelWidth columns, laid out for
// DenseKernels::solve_right: L21 := A21 U11^{-1} and U12^T := A12^T L11^{-T}.
struct DiagonalBlock {
  double upper[kPanelWidth * kPanelWidth];  // U11, column-major
  double lower[kPanelWidth * kPanelWidth];  // L11^T, column-major
  double inverse_pivots[kPanelWidth];

  // @param block  holds both triangles, or the lower one alone if symmetric
  bool Factorize(double* block, long ld, int width, bool symmetric) {
    double a[kPanelWidth][kPanelWidth];
    double largest = 0.0;
    for (int j = 0; j < width; ++j) {
      for (int i = symmetric ? j : 0; i < width; ++i) {
        a[i][j] = block[i + j * ld];
        largest = std::max(largest, std::abs(a[i][j]));
      }
    }
    for (int k = 0; k < width; ++k) {
      if (!(std::abs(a[k][k]) > kMinPivot * largest) || !std::isfinite(a[k][k])) {
        return false;
      }
      inverse_pivots[k] = 1.0 / a[k][k];
      for (int i = k + 1; i < width; ++i) {
        if (symmetric) a[k][i] = a[i][k];
        a[i][k] *= inverse_pivots[k];
        const int end = symmetric ? i + 1 : width;
        for (int j = k + 1; j < end; ++j) a[i][j] -= a[i][k] * a[k][j];
      }
    }
    for (int j = 0; j < width; ++j) {
      for (int i = 0; i < width; ++i) block[i + j * ld] = a[i][j];
      for (int i = j; i < width; ++i) {
        upper[j + kPanelWidth * i] = a[j][i];
        lower[j + kPanelWidth * i] = a[i][j];
      }
    }
    return true;
  }

  // x := L11^{-1} x for the `count` columns of x, as rows of its transpose.
  void SolveRows(int width, int count, double* x, long ld) const {
    constexpr int kRows = 64;
    double rows[kRows * kPanelWidth];
    for (; count > 0; count -= kRows, x += kRows * ld) {
      const int m = std::min(count, kRows);
      for (int i = 0; i < m; ++i) {
        for (int j = 0; j < width; ++j) rows[i + kRows * j] = x[j + i * ld];
      }
      BestDenseKernels().solve_right(m, width, lower, kOnes, rows, kRows);
      for (int i = 0; i < m; ++i) {
        for (int j = 0; j < width; ++j) x[j + i * ld] = rows[i + kRows * j];
      }
    }
  }
};

}  // namespace

SupernodalLu::SupernodalLu(std::shared_ptr<const SupernodalStructure> structure)
    : structure_(std::move(structure)) {}

bool SupernodalLu::Factorize(const double* values, bool symmetric,
                             std::vector<double>* work, SupernodalPanels* copy) {
  symmetric_ = symmetric;
  panels_.Allocate(*structure_, symmetric);
  if (copy != nullptr) copy->Allocate(*structure_, symmetric);
  work->resize(structure_->workspace_size + kTriangleColumns * structure_->max_columns);
  for (int s = 0; s < structure_->num_supernodes; ++s) {
    Assemble(s, values);
    for (int c = structure_->first_child[s]; c >= 0; c = structure_->next_sibling[c]) {
      AddToPanels(c, s, work->data() + structure_->remainder_start[c]);
    }
    if (!FactorizeColumns(s, 0, structure_->num_columns(s))) return false;
    MakeRemainder(s, work->data());
    if (copy != nullptr) CopyPanels(s, copy);
  }
  if (copy != nullptr) BestDenseKernels().end_stream();
  return true;
}

// Copies what of the arrays is ready once supernode `s` is, in whole lines.
void SupernodalLu::CopyPanels(int s, SupernodalPanels* copy) const {
  const auto stream = [&](const std::vector<size_t>& start, const double* from,
                          double* to) {
    constexpr size_t kLine = SupernodalPanels::kLine;
    const bool is_last = s + 1 == structure_->num_supernodes;
    const size_t begin = start[s] / kLine * kLine;
    const size_t end = (start[s + 1] + (is_last ? kLine - 1 : 0)) / kLine * kLine;
    BestDenseKernels().stream(end - begin, from + begin, to + begin);
  };
  stream(structure_->value_start, panels_.lower(), copy->lower());
  if (!symmetric_) stream(structure_->upper_start, panels_.upper(), copy->upper());
}

// The panels of `s` := the matrix's entries.
void SupernodalLu::Assemble(int s, const double* values) {
  const int columns = structure_->num_columns(s);
  const long rows = structure_->num_rows(s), below = rows - columns;
  double* const lower = LowerPanel(s);
  double* const upper = UpperPanel(s);
  std::fill_n(lower, rows * columns, 0.0);
  if (!symmetric_) std::fill_n(upper, below * columns, 0.0);
  for (int k = structure_->pair_start[s]; k < structure_->pair_start[s + 1]; ++k) {
    const SupernodalStructure::BlockPair& pair = structure_->pairs[k];
    const double* l = values + pair.lower.offset;
    const double* u = values + pair.upper.offset;
    double* out = lower + pair.row + pair.column * rows;
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r) out[r + c * rows] = l[r + c * pair.lower.stride];
    }
    if (symmetric_ || pair.row == pair.column) continue;
    if (pair.row < columns) {
      out = lower + pair.column + pair.row * rows;
      for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) out[c + r * rows] = u[c + r * pair.upper.stride];
      }
    } else {
      out = upper + pair.row - columns + pair.column * below;
      for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) out[r + c * below] = u[c + r * pair.upper.stride];
      }
    }
  }
}

// Adds those entries of the remainder of `child` that belong to own columns or own rows
// of the parent `s` to its panels.
void SupernodalLu::AddToPanels(int child, int s, const double* remainder) {
  const long size = structure_->num_below(child);
  const int columns = structure_->num_columns(s);
  const long rows = structure_->num_rows(s), below = rows - columns;
  double* const lower = LowerPanel(s);
  double* const upper = UpperPanel(s);
  using Run = SupernodalStructure::Run;
  const Run* const begin = structure_->runs.data() + structure_->run_start[child];
  const Run* const end = structure_->runs.data() + structure_->run_start[child + 1];
  for (const Run* run = begin; run != end && run->place < columns; ++run) {
    for (int k = 0; k < run->length; ++k) {
      const int j = run->first + k;
      const double* column = remainder + j * size;
      const double* row = remainder + j;
      double* l = lower + (run->place + k) * rows;
      double* u = symmetric_ ? nullptr : upper + (run->place + k) * below - columns;
      for (const Run* other = symmetric_ ? run : begin; other != end; ++other) {
        const long first = other->first;
        for (int i = 0; i < other->length; ++i) {
          l[other->place + i] += column[first + i];
        }
        if (symmetric_ || other->place < columns) continue;
        for (int i = 0; i < other->length; ++i) {
          u[other->place + i] += row[(first + i) * size];
        }
      }
    }
  }
}

// The remainder of `s` := -L21 U12 and what its children leave to it.
void SupernodalLu::MakeRemainder(int s, double* work) {
  const int columns = structure_->num_columns(s);
  const long rows = structure_->num_rows(s);
  const int below = static_cast<int>(rows) - columns;
  if (below == 0) return;
  double* const remainder = work + structure_->remainder_start[s];
  if (symmetric_) {
    MakeSymmetricRemainder(s, work + structure_->workspace_size, remainder);
  } else {
    BestDenseKernels().subtract_product(
        /*overwrite=*/true, below, below, columns, LowerPanel(s) + columns, rows,
        UpperPanel(s), 1, below, remainder, below);
  }
  for (int c = structure_->first_child[s]; c >= 0; c = structure_->next_sibling[c]) {
    AddToRemainder(c, s, work + structure_->remainder_start[c], remainder);
  }
}

// The part of -L21 D L21^T on and below the diagonal, some columns at a time; `scaled`
// receives the rows of L21 D that they need.
void SupernodalLu::MakeSymmetricRemainder(int s, double* scaled, double* remainder) {
  const int columns = structure_->num_columns(s);
  const long rows = structure_->num_rows(s), below = rows - columns;
  const double* const lower = LowerPanel(s);
  for (long j = 0; j < below; j += kTriangleColumns) {
    const int count = static_cast<int>(std::min<long>(kTriangleColumns, below - j));
    const double* const l21 = lower + columns + j;
    for (int p = 0; p < columns; ++p) {
      const double pivot = lower[p + p * rows];
      for (int i = 0; i < count; ++i) {
        scaled[i + p * kTriangleColumns] = pivot * l21[i + p * rows];
      }
    }
    BestDenseKernels().subtract_product(
        /*overwrite=*/true, static_cast<int>(below - j), count, columns, l21, rows,
        scaled, 1, kTriangleColumns, remainder + j + j * below, below);
  }
}

// Adds the other entries of the remainder of `child`, those between rows below the own
// columns of the parent `s`, to its remainder.
void SupernodalLu::AddToRemainder(int child, int s, const double* in,
                                  double* remainder) {
  using Run = SupernodalStructure::Run;
  const int columns = structure_->num_columns(s);
  const long below = structure_->num_below(s), size = structure_->num_below(child);
  const Run* begin = structure_->runs.data() + structure_->run_start[child];
  const Run* const end = structure_->runs.data() + structure_->run_start[child + 1];
  while (begin != end && begin->place < columns) ++begin;
  for (const Run* run = begin; run != end; ++run) {
    for (int k = 0; k < run->length; ++k) {
      const double* column = in + (run->first + k) * size;
      double* out = remainder + (run->place + k - columns) * below - columns;
      for (const Run* other = symmetric_ ? run : begin; other != end; ++other) {
        for (int i = 0; i < other->length; ++i) {
          out[other->place + i] += column[other->first + i];
        }
      }
    }
  }
}

bool SupernodalLu::FactorizeColumns(int s, int begin, int end) {
  if (end - begin <= kPanelWidth) return FactorizePanel(s, begin, end);
  const int half = (end - begin + 1) / 2;
  const int middle = begin + (half + kPanelWidth - 1) / kPanelWidth * kPanelWidth;
  if (!FactorizeColumns(s, begin, middle)) return false;
  UpdateColumns(s, begin, middle, end);
  return FactorizeColumns(s, middle, end);
}

// Subtracts what the columns of L, and rows of U, in [begin, middle) contribute to
// those in [middle, end).
void SupernodalLu::UpdateColumns(int s, int begin, int middle, int end) {
  const int columns = structure_->num_columns(s);
  const int rows = structure_->num_rows(s), below = rows - columns;
  const int terms = middle - begin, width = end - middle;
  double* const lower = LowerPanel(s);
  double* const upper = UpperPanel(s);
  const auto at = [&](int i, int j) { return lower + i + static_cast<long>(j) * rows; };
  const DenseKernels& kernels = BestDenseKernels();
  kernels.subtract_product(false, rows - middle, width, terms, at(middle, begin), rows,
                           at(begin, middle), rows, 1, at(middle, middle), rows);
  if (symmetric_) return;
  kernels.subtract_product(false, width, columns - end, terms, at(middle, begin), rows,
                           at(begin, end), rows, 1, at(middle, end), rows);
  kernels.subtract_product(
      false, below, width, terms, upper + static_cast<long>(begin) * below, below,
      at(middle, begin), 1, rows, upper + static_cast<long>(middle) * below, below);
}

bool SupernodalLu::FactorizePanel(int s, int begin, int end) {
  const int columns = structure_->num_columns(s), width = end - begin;
  const long rows = structure_->num_rows(s), below = rows - columns;
  double* const l = LowerPanel(s) + begin * rows;
  double* const right = l + begin + width * rows;  // U11 beyond the diagonal block
  DiagonalBlock diagonal;
  if (!diagonal.Factorize(l + begin, rows, width, symmetric_)) return false;
  const DenseKernels& kernels = BestDenseKernels();
  kernels.solve_right(static_cast<int>(rows) - end, width, diagonal.upper,
                      diagonal.inverse_pivots, l + end, rows);
  if (!symmetric_) {
    diagonal.SolveRows(width, columns - end, right, rows);
    kernels.solve_right(static_cast<int>(below), width, diagonal.lower, kOnes,
                        UpperPanel(s) + begin * below, below);
    return true;
  }
  for (int j = 0; j < width; ++j) {
    const double pivot = diagonal.upper[j + kPanelWidth * j];
    const double* column = l + j * rows;
    for (int i = end; i < columns; ++i) right[j + (i - end) * rows] = pivot * column[i];
  }
  return true;
}

}  // namespace dpe
