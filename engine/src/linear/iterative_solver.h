// Krylov solution of large step systems A z = b and A^T z = b, to a relative residual
// that the user chooses.
//
// The generalised conjugate residual method (Eisenstat, Elman & Schultz 1983), which is
// flexible GMRES (Saad 1993) in other words, preconditioned by one multigrid cycle M
// (multigrid.h) and restarted after m directions u with orthonormal q:
//   u_j = M r,  h_jj q_j = A u_j - sum_i<j h_ij q_i,  a_j = q_j.r,  r -= a_j q_j;
//   at the end z += sum_j y_j u_j with H y = a.
// Each iteration takes one product and one cycle and makes the residual no larger,
// whatever A is: symmetric or not, definite or not. As M is nearly as good as A^{-1},
// there are few directions, and keeping them all costs little; on indefinite matrices
// (compressed springs) keeping only the last ones would lose convergence altogether.
#ifndef DPE_ENGINE_LINEAR_ITERATIVE_SOLVER_H_
#define DPE_ENGINE_LINEAR_ITERATIVE_SOLVER_H_

#include <vector>

#include "linear/block_pattern.h"
#include "linear/multigrid.h"

namespace dpe {

struct IterativeResult {
  bool converged = false;
  int iterations = 0;
};

class IterativeSolver {
 public:
  // The pattern must outlive the solver.
  explicit IterativeSolver(const BlockPattern& pattern) : pattern_(pattern) {}

  // Prepares to solve with A, or A^T if `transposed`, for the matrix in `values`, which
  // must stay as it is while it is solved with.
  // @return false if it has no preconditioner, being singular or not finite
  bool Prepare(const std::vector<double>& values, bool transposed);

  // Solves A z = b (A^T z = b) to |b - A z| <= tolerance |b|, as verified at the end.
  //
  // @param z  in: the first guess; out: the solution. b and z must not overlap.
  // @return   not converged if the residual stops to fall, or is not finite
  IterativeResult Solve(double tolerance, const double* b, double* z);

  const Multigrid& preconditioner() const { return multigrid_; }

 private:
  static constexpr int kDirections = 40;

  struct Direction {
    std::vector<float> u;  // as single as M
    std::vector<double> q;
    double h[kDirections];  // column of H
    double a = 0.0;
  };

  void Multiply(const double* x, double* y) const;
  // z := c z for the best c, and r_ := b - A z. Returns |r_|.
  double Start(const double* b, double* z);
  // r_ := b - A z. Returns its norm.
  double TrueResidual(const double* b, const double* z);
  // Adds a direction and reduces r_ along it. Returns its new norm, NaN on a breakdown.
  double Iterate(double norm);
  // z += sum_j y_j u_j, and forgets the directions.
  void AddDirections(double* z);

  const BlockPattern& pattern_;
  const double* values_ = nullptr;
  bool transposed_ = false;
  Multigrid multigrid_;
  std::vector<double> r_, work_;
  std::vector<Direction> directions_;  // the first num_directions_
  int num_directions_ = 0;
};

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_ITERATIVE_SOLVER_H_
