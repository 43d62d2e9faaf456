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

// The factors of a diagonal block of up to kPanelWidth columns, laid out for
// DenseKernels::solve_right: L21 := A21 U11^{-1} and U12^T := A12^T L11^{-T}.
struct DiagonalBlock {
  double upper[kPanelWidth * kPanelWidth];  // U11, column-major
  double lower[kPanelWidth * kPanelWidth];  // L11^T, column-major
  double inverse_pivots[kPanelWidth];

  // @param l, u  the block's first entry in the panels of L and U^T
  bool Factorize(double* l, double* u, long ld, int width, bool symmetric) {
    double a[kPanelWidth][kPanelWidth];
    double largest = 0.0;
    for (int j = 0; j < width; ++j) {
      for (int i = 0; i < width; ++i) {
        a[i][j] = i >= j ? l[i + j * ld] : symmetric ? l[j + i * ld] : u[j + i * ld];
        largest = std::max(largest, std::abs(a[i][j]));
      }
    }
    for (int k = 0; k < width; ++k) {
      if (!(std::abs(a[k][k]) > kMinPivot * largest) || !std::isfinite(a[k][k])) {
        return false;
      }
      inverse_pivots[k] = 1.0 / a[k][k];
      for (int i = k + 1; i < width; ++i) {
        a[i][k] *= inverse_pivots[k];
        for (int j = k + 1; j < width; ++j) a[i][j] -= a[i][k] * a[k][j];
      }
    }
    for (int j = 0; j < width; ++j) {
      for (int i = j; i < width; ++i) {
        l[i + j * ld] = i == j ? 1.0 : a[i][j];
        u[i + j * ld] = a[j][i];
        upper[j + kPanelWidth * i] = a[j][i];
        lower[j + kPanelWidth * i] = a[i][j];
      }
    }
    return true;
  }
};

constexpr double kOnes[kPanelWidth] = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0};

}  // namespace

SupernodalLu::SupernodalLu(std::shared_ptr<const SupernodalStructure> structure)
    : structure_(std::move(structure)),
      lower_(structure_->num_values()),
      upper_(structure_->num_values()) {}

bool SupernodalLu::Factorize(const double* values, bool symmetric,
                             std::vector<double>* work) {
  symmetric_ = symmetric;
  work->resize(structure_->workspace_size);
  for (int s = 0; s < structure_->num_supernodes; ++s) {
    Assemble(s, values);
    for (int c = structure_->first_child[s]; c >= 0; c = structure_->next_sibling[c]) {
      AddToPanels(c, s, work->data() + structure_->remainder_start[c]);
    }
    if (!FactorizeColumns(s, 0, structure_->num_columns(s))) return false;
    MakeRemainder(s, work->data());
  }
  return true;
}

// The panels of `s` := the matrix's entries.
void SupernodalLu::Assemble(int s, const double* values) {
  const size_t start = structure_->value_start[s];
  const int rows = structure_->num_rows(s);
  double* lower = lower_.data() + start;
  double* upper = upper_.data() + start;
  const size_t size = structure_->value_start[s + 1] - start;
  std::fill_n(lower, size, 0.0);
  if (!symmetric_) std::fill_n(upper, size, 0.0);
  for (int k = structure_->pair_start[s]; k < structure_->pair_start[s + 1]; ++k) {
    const SupernodalStructure::BlockPair& pair = structure_->pairs[k];
    const double* l = values + pair.lower.offset;
    const double* u = values + pair.upper.offset;
    for (int c = 0; c < 3; ++c) {
      double* l_column = lower + pair.target + c * rows;
      double* u_column = upper + pair.target + c * rows;
      for (int r = 0; r < 3; ++r) l_column[r] = l[r + c * pair.lower.stride];
      if (symmetric_) continue;
      for (int r = 0; r < 3; ++r) u_column[r] = u[c + r * pair.upper.stride];
    }
  }
}

// Adds those entries of the remainder of `child` whose smaller place is an own column
// of the parent `s` to its panels: on and below the diagonal to L, on and above to U^T.
void SupernodalLu::AddToPanels(int child, int s, const double* remainder) {
  const int size = structure_->num_rows(child) - structure_->num_columns(child);
  const int columns = structure_->num_columns(s);
  const long rows = structure_->num_rows(s);
  double* lower = lower_.data() + structure_->value_start[s];
  double* upper = upper_.data() + structure_->value_start[s];
  const SupernodalStructure::Run* run =
      structure_->runs.data() + structure_->run_start[child];
  const SupernodalStructure::Run* const end =
      structure_->runs.data() + structure_->run_start[child + 1];
  for (; run != end && run->place < columns; ++run) {
    for (int k = 0; k < run->length; ++k) {
      const int j = run->first + k;
      const double* column = remainder + static_cast<long>(j) * size;
      const double* row = remainder + j;
      double* l = lower + (run->place + k) * rows;
      double* u = upper + (run->place + k) * rows;
      for (const SupernodalStructure::Run* other = run; other != end; ++other) {
        const long first = other->first;
        for (int i = 0; i < other->length; ++i) {
          l[other->place + i] += column[first + i];
        }
        for (int i = 0; i < other->length && !symmetric_; ++i) {
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
  const size_t start = structure_->value_start[s] + columns;
  double* const remainder = work + structure_->remainder_start[s];
  // Column by column as much of it as there is below the diagonal, if symmetric.
  const int width = symmetric_ ? kTriangleColumns : below;
  for (int j = 0; j < below; j += width) {
    const int i = symmetric_ ? j : 0;
    BestDenseKernels().subtract_product(
        /*overwrite=*/true, below - i, std::min(width, below - j), columns,
        lower_.data() + start + i, rows, upper_.data() + start + j, 1, rows,
        remainder + i + static_cast<long>(j) * below, below);
  }
  for (int c = structure_->first_child[s]; c >= 0; c = structure_->next_sibling[c]) {
    AddToRemainder(c, s, work + structure_->remainder_start[c], remainder);
  }
}

// Adds the other entries of the remainder of `child`, those between rows below the own
// columns of the parent `s`, to its remainder.
void SupernodalLu::AddToRemainder(int child, int s, const double* in,
                                  double* remainder) {
  using Run = SupernodalStructure::Run;
  const int columns = structure_->num_columns(s);
  const long below = structure_->num_rows(s) - columns;
  const long size = structure_->num_rows(child) - structure_->num_columns(child);
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
  const long rows = structure_->num_rows(s);
  const auto update = [&](std::vector<double>* panel,
                          const std::vector<double>& other) {
    double* const x = panel->data() + structure_->value_start[s];
    const double* const y = other.data() + structure_->value_start[s];
    BestDenseKernels().subtract_product(
        /*overwrite=*/false, static_cast<int>(rows) - middle, end - middle,
        middle - begin, x + middle + begin * rows, rows, y + middle + begin * rows, 1,
        rows, x + middle + middle * rows, rows);
  };
  update(&lower_, upper_);
  if (!symmetric_) update(&upper_, lower_);
  return FactorizeColumns(s, middle, end);
}

bool SupernodalLu::FactorizePanel(int s, int begin, int end) {
  const long rows = structure_->num_rows(s);
  const size_t start = structure_->value_start[s] + begin * rows;
  double* l = lower_.data() + start;
  double* u = upper_.data() + start;
  const int width = end - begin;
  DiagonalBlock diagonal;
  if (!diagonal.Factorize(l + begin, u + begin, rows, width, symmetric_)) return false;
  const DenseKernels& kernels = BestDenseKernels();
  const int below = static_cast<int>(rows) - end;
  kernels.solve_right(below, width, diagonal.upper, diagonal.inverse_pivots, l + end,
                      rows);
  if (!symmetric_) {
    kernels.solve_right(below, width, diagonal.lower, kOnes, u + end, rows);
    return true;
  }
  for (int j = 0; j < width; ++j) {
    const double pivot = diagonal.upper[j + kPanelWidth * j];
    for (long i = end + j * rows; i < (j + 1) * rows; ++i) u[i] = pivot * l[i];
  }
  return true;
}

SupernodalFactor SupernodalLu::factor() const {
  SupernodalFactor factor;
  factor.num_supernodes = structure_->num_supernodes;
  factor.first_column = structure_->first_column.data();
  factor.row_start = structure_->row_start.data();
  factor.row_indices = structure_->rows.data();
  factor.value_start = structure_->value_start.data();
  factor.lower = lower_.data();
  factor.upper = upper_.data();
  return factor;
}

}  // namespace dpe
