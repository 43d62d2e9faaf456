#include "linear/block_solver.h"

#include <algorithm>

#include "linear/lapack.h"

namespace dpe {

BlockSolver::BlockSolver(const BlockPattern& pattern) : pattern_(pattern) {}

bool BlockSolver::Prepare(StepSolver* solver, bool symmetric, int num_columns) {
  const int n = pattern_.num_rows();
  solver_ = solver;
  // A dense factorisation costs n^3 * 2/3; it pays from a few dozen columns on.
  dense_ = IsDense(n, num_columns);
  if (!dense_) return solver->Factorize(symmetric);
  lu_.assign(static_cast<size_t>(n) * n, 0.0);
  pivots_.resize(n);
  const std::vector<int>& starts = pattern_.column_starts();
  for (int j = 0; j < n; ++j) {
    for (int k = starts[j]; k < starts[j + 1]; ++k) {
      lu_[static_cast<size_t>(j) * n + pattern_.row_indices()[k]] = solver->values()[k];
    }
  }
  int info = 0;
  dgetrf_(&n, &n, lu_.data(), &n, pivots_.data(), &info);
  return info == 0;
}

bool BlockSolver::Solve(double* right, int count, bool transposed) const {
  const int n = pattern_.num_rows();
  if (!dense_) {
    std::vector<double> b(n), z(n);
    for (int c = 0; c < count; ++c) {
      for (int r = 0; r < n; ++r) b[r] = right[static_cast<size_t>(r) * count + c];
      if (!solver_->Solve(b.data(), z.data(), transposed)) return false;
      for (int r = 0; r < n; ++r) right[static_cast<size_t>(r) * count + c] = z[r];
    }
    return true;
  }
  // Read column-major, the array is Y = Z^T (count x n). With P A = L U:
  //   A Z = B    <=>  Y A^T = B^T  <=>  Y U^T L^T = B^T P^T,
  //   A^T Z = B  <=>  Y A = B^T    <=>  Y P^T L U = B^T.
  const double one = 1.0;
  const auto swap_rows = [&](int i) {
    const int p = pivots_[i] - 1;
    if (p == i) return;
    std::swap_ranges(right + static_cast<size_t>(i) * count,
                     right + static_cast<size_t>(i + 1) * count,
                     right + static_cast<size_t>(p) * count);
  };
  if (!transposed) {
    for (int i = 0; i < n; ++i) swap_rows(i);
    dtrsm_("R", "L", "T", "U", &count, &n, &one, lu_.data(), &n, right, &count);
    dtrsm_("R", "U", "T", "N", &count, &n, &one, lu_.data(), &n, right, &count);
  } else {
    dtrsm_("R", "U", "N", "N", &count, &n, &one, lu_.data(), &n, right, &count);
    dtrsm_("R", "L", "N", "U", &count, &n, &one, lu_.data(), &n, right, &count);
    for (int i = n - 1; i >= 0; --i) swap_rows(i);
  }
  return true;
}

}  // namespace dpe
