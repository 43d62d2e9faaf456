// Krylov methods for large step matrices, to a relative residual that the user chooses:
// conjugate gradients (Hestenes & Stiefel 1952) where the matrix is symmetric, BiCGStab
// (van der Vorst 1992) otherwise, preconditioned by the inverses of the 3x3 diagonal
// blocks.
#ifndef DPE_ENGINE_LINEAR_ITERATIVE_SOLVER_H_
#define DPE_ENGINE_LINEAR_ITERATIVE_SOLVER_H_

#include <vector>

#include "linear/block_pattern.h"

namespace dpe {

// The inverted diagonal blocks of a matrix.
class BlockJacobi {
 public:
  // False if a block is singular or not finite.
  bool Compute(const BlockPattern& pattern, const std::vector<double>& values);
  // z = D^{-1} r, or D^{-T} r.
  void Apply(const double* r, double* z, bool transposed) const;

 private:
  std::vector<double> inverses_;  // 9 per node, column-major
};

struct IterativeResult {
  bool converged = false;
  int iterations = 0;
};

// Vectors that solves reuse.
struct IterativeWorkspace {
  std::vector<double> r, p, q, s, t, shadow, preconditioned;
};

// Solves A z = b (A^T z = b if `transposed`) to |b - A z| <= tolerance |b|.
//
// @param symmetric  A is symmetric: conjugate gradients, which also fail, cleanly, if A
//                   turns out not to be positive definite
// @param z          in: the first guess; out: the solution
IterativeResult SolveIteratively(const BlockPattern& pattern,
                                 const std::vector<double>& values,
                                 const BlockJacobi& preconditioner, bool symmetric,
                                 bool transposed, double tolerance, const double* b,
                                 double* z, IterativeWorkspace* work);

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_ITERATIVE_SOLVER_H_
