// Triangular solves with a supernodal factorisation A = L U, for one right-hand side
// and for many.
//
// CHOLMOD's own solve calls BLAS four times per supernode, which for the narrow
// supernodes of small cloths costs more than the arithmetic (19 us instead of 7 us at
// 12 x 12 vertices). These run plain loops, and dense_kernels.h, over the same panels.
#ifndef DPE_ENGINE_LINEAR_SUPERNODAL_SOLVE_H_
#define DPE_ENGINE_LINEAR_SUPERNODAL_SOLVE_H_

#include <cstddef>
#include <vector>

namespace dpe {

// The arrays of a supernodal factor, see supernodal_structure.h: the panels of L (whose
// diagonal is 1) with the own parts of U, and those of U^T. A symmetric matrix has none
// of the latter: U = D L^T, with the pivots D on the diagonal of the own parts.
struct SupernodalFactor {
  int num_supernodes = 0;
  const int* first_column = nullptr;
  const int* row_start = nullptr;
  const int* row_indices = nullptr;
  const size_t* value_start = nullptr;
  const size_t* upper_start = nullptr;
  const double* lower = nullptr;
  const double* upper = nullptr;  // null if symmetric

  bool is_transposed = false;  // stands for A^T = U^T L^T

  SupernodalFactor Transposed() const {
    SupernodalFactor transposed = *this;
    transposed.is_transposed = !is_transposed;
    return transposed;
  }
};

// x := A^{-1} x, in the factor's own ordering. `work` is resized as needed.
void SolveSupernodal(const SupernodalFactor& factor, std::vector<double>* work,
                     double* x);

// The same for `count` right-hand sides, the columns of a row-major array x.
void SolveSupernodalMany(const SupernodalFactor& factor, int count,
                         std::vector<double>* work, double* x);

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_SUPERNODAL_SOLVE_H_
