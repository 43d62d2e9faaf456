// Solves A Z = B and A^T Z = B for many right-hand sides at once, as tangent Jacobians
// and blocks of adjoint vectors need. Right-hand sides are the columns of a row-major
// n x m array, so that sparse products on it stream over contiguous memory.
//
// Up to kDenseLimit unknowns A is factorised densely (LAPACK dgetrf): a dense
// triangular solve runs at the speed of matrix products, which beats several sparse
// sweeps per column there. Larger systems go column by column through StepSolver.
#ifndef DPE_ENGINE_LINEAR_BLOCK_SOLVER_H_
#define DPE_ENGINE_LINEAR_BLOCK_SOLVER_H_

#include <vector>

#include "linear/block_pattern.h"
#include "linear/step_solver.h"

namespace dpe {

class BlockSolver {
 public:
  static constexpr int kDenseLimit = 1300;

  // Whether Prepare factorises densely for so many columns.
  static bool IsDense(int num_rows, int num_columns) {
    return num_rows <= kDenseLimit && num_columns >= num_rows / 8;
  }

  explicit BlockSolver(const BlockPattern& pattern);

  // Prepares for `solver`'s matrix, whose values must be assembled. `num_columns` is
  // the total number of right-hand sides that will follow.
  // @return false if the matrix cannot be factorised
  bool Prepare(StepSolver* solver, bool symmetric, int num_columns);

  // Solves in place for `count` columns, row-major n x count. May be called from
  // several threads at once if thread_safe().
  bool Solve(double* right, int count, bool transposed) const;

  bool thread_safe() const { return dense_; }

 private:
  const BlockPattern& pattern_;
  StepSolver* solver_ = nullptr;
  bool dense_ = false;
  std::vector<double> lu_;  // column-major n x n
  std::vector<int> pivots_;
};

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_BLOCK_SOLVER_H_
