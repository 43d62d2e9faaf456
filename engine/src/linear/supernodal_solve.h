// Triangular solves with a supernodal factor L L^T, for one right-hand side.
//
// CHOLMOD's own solve calls BLAS four times per supernode, which for the narrow
// supernodes of small cloths costs more than the arithmetic (19 us instead of 7 us at
// 12 x 12 vertices). This one runs plain loops over the same factor.
#ifndef DPE_ENGINE_LINEAR_SUPERNODAL_SOLVE_H_
#define DPE_ENGINE_LINEAR_SUPERNODAL_SOLVE_H_

#include <vector>

namespace dpe {

// The arrays of a supernodal factor, as CHOLMOD lays them out. Supernode s holds the
// columns [first_column[s], first_column[s+1]) and the rows row_indices[row_start[s]
// ...], its own columns first; its values are dense, column-major, at value_start[s].
struct SupernodalFactor {
  int num_supernodes = 0;
  const int* first_column = nullptr;
  const int* row_start = nullptr;
  const int* value_start = nullptr;
  const int* row_indices = nullptr;
  const double* values = nullptr;
};

// x := L^{-T} L^{-1} x, in the factor's own ordering. `work` is resized as needed.
void SolveSupernodal(const SupernodalFactor& factor, std::vector<double>* work,
                     double* x);

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_SUPERNODAL_SOLVE_H_
