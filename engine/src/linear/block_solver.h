// Solves A Z = B and A^T Z = B for many right-hand sides at once, as tangent Jacobians
// and blocks of adjoint vectors need. Right-hand sides are the columns of a row-major
// n x m array, so that sparse products on it stream over contiguous memory.
//
// The sparse factors of A serve all of them, a block of columns at a time, so that the
// factors are read once per block and the arithmetic is that of dense products. Where A
// has no exact factors (direct_solver.h) columns are solved one by one.
#ifndef DPE_ENGINE_LINEAR_BLOCK_SOLVER_H_
#define DPE_ENGINE_LINEAR_BLOCK_SOLVER_H_

#include <vector>

#include "linear/block_pattern.h"
#include "linear/step_solver.h"
#include "linear/supernodal_solve.h"

namespace dpe {

class BlockSolver {
 public:
  // With fewer columns than this the Krylov method, where a system has it, is cheaper
  // than a factorisation.
  static constexpr int kMinColumnsToFactorize = 12;

  explicit BlockSolver(const BlockPattern& pattern) : pattern_(pattern) {}

  // Prepares for `solver`'s matrix, whose values must be assembled; `solver` must stay
  // as it is until the last Solve. `num_columns` is the total number of right-hand
  // sides that will follow.
  // @return false if the matrix cannot be factorised
  bool Prepare(StepSolver* solver, bool symmetric, int num_columns);

  // Solves in place for `count` columns, row-major n x count. May be called from
  // several threads at once if thread_safe().
  bool Solve(double* right, int count, bool transposed) const;

  bool thread_safe() const { return factor_.lower != nullptr; }

 private:
  bool SolveOneByOne(double* right, int count, bool transposed) const;

  const BlockPattern& pattern_;
  StepSolver* solver_ = nullptr;
  SupernodalFactor factor_;
};

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_BLOCK_SOLVER_H_
