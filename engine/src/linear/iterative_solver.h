// Krylov solution of large step systems A z = b and A^T z = b, to a relative residual
// that the user chooses: in the plain norm and in that of block_scaling.h, since either
// alone leaves equations unsolved where stiff contact makes others 1e5 times as large.
//
// The generalised conjugate residual method (Eisenstat, Elman & Schultz 1983), which is
// flexible GMRES (Saad 1993) in other words, preconditioned by one multigrid cycle M
// (multigrid.h). From r = b - A z it makes directions u with orthonormal q,
//   u_j = M r,  h_jj q_j = A u_j - sum_i<j h_ij q_i,  a_j = q_j.r,  r -= a_j q_j,
// and at last z += sum_j y_j u_j with H y = a. Each takes one product and one cycle and
// makes the residual no larger, whatever A is: symmetric or not, definite or not. As M
// is nearly as good as A^{-1}, there are few directions, and keeping them all costs
// little; on indefinite matrices (compressed springs) keeping only the last ones loses
// convergence altogether.
//
// All that is done in single precision, which halves the memory to be read; but the
// residual that it starts from is computed in double precision, and again at the end,
// and what is left to the tolerance is made up by starting over (iterative refinement,
// Carson & Higham 2018). So z is as good as if all were double.
#ifndef DPE_ENGINE_LINEAR_ITERATIVE_SOLVER_H_
#define DPE_ENGINE_LINEAR_ITERATIVE_SOLVER_H_

#include <vector>

#include "linear/block_pattern.h"
#include "linear/block_scaling.h"
#include "linear/multigrid.h"

namespace dpe {

struct IterativeResult {
  bool converged = false;
  int iterations = 0;
};

class IterativeSolver {
 public:
  // The pattern must outlive the solver.
  explicit IterativeSolver(const BlockPattern& pattern)
      : pattern_(pattern), scaling_(pattern) {}

  // Prepares to solve with A, or A^T if `transposed`, for the matrix in `values`, which
  // must stay as it is while it is solved with.
  // @return false if it has no preconditioner, being singular or not finite
  bool Prepare(const std::vector<double>& values, bool transposed);

  // Solves A z = b (A^T z = b) to |b - A z| <= tolerance |b| and
  // |b - A z|_D <= tolerance |b|_D (block_scaling.h), as verified at the end.
  //
  // @param z  in: the first guess; out: the solution. b and z must not overlap.
  // @return   not converged if the residual stops to fall, or is not finite
  IterativeResult Solve(double tolerance, const double* b, double* z);

  const Multigrid& preconditioner() const { return multigrid_; }

 private:
  static constexpr int kDirections = 40;

  struct Direction {
    std::vector<float> u, q;
    float h[kDirections];  // column of H
    double a = 0.0;
  };

  // z := c z for the best c. Like TrueResidual for that.
  double Start(const double* b, double* z);
  // residual_ := b - A z. Returns its norm.
  double TrueResidual(const double* b, const double* z);
  // Improves z until the residual, which has norm `norm`, is reduced by the factor
  // `reduction`, as far as single precision can tell, or there are kDirections
  // directions. False on a breakdown.
  bool Reduce(double reduction, double norm, double* z);
  // Adds a direction and reduces r_ along it. False on a breakdown.
  bool AddDirection();

  const BlockPattern& pattern_;
  BlockScaling scaling_;
  const double* values_ = nullptr;
  bool transposed_ = false;
  Multigrid multigrid_;
  std::vector<double> residual_;
  std::vector<float> r_;
  std::vector<Direction> directions_;  // the first num_directions_
  int num_directions_ = 0;
};

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_ITERATIVE_SOLVER_H_
