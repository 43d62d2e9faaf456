// Solves A z = b and A^T z = b for the matrix of one integration step.
//
// A is nearly symmetric: only spring damping and drag make it non-symmetric, and it is
// positive definite unless springs are strongly compressed. So
//   1. the symmetric part S = (A + A^T) / 2 is factorised by sparse Cholesky;
//   2. if A is symmetric that is the answer; otherwise restarted GMRES (Saad & Schultz
//      1986) on A, preconditioned by S, iterates to rounding level;
//   3. if S is not positive definite, or GMRES does not get there, A is factorised by
//      sparse LU with partial pivoting (Eigen::SparseLU), which needs neither.
// Each way gives the solution of the same exact system, so derivative passes are exact.
#ifndef DPE_ENGINE_LINEAR_STEP_SOLVER_H_
#define DPE_ENGINE_LINEAR_STEP_SOLVER_H_

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <memory>
#include <vector>

#include "linear/block_pattern.h"
#include "linear/cholesky.h"

namespace dpe {

class StepSolver {
 public:
  // The pattern must outlive the solver.
  explicit StepSolver(const BlockPattern& pattern);

  // Where the caller assembles A before Factorize.
  std::vector<double>& values() { return values_; }
  const std::vector<double>& values() const { return values_; }

  // @param symmetric  the caller knows that A is symmetric
  // @return           false if the matrix is found to be singular; one that is not
  //                   finite may only show in Solve
  bool Factorize(bool symmetric);

  // z = A^{-1} b, or A^{-T} b if `transposed`; b and z may be the same array. False if
  // that cannot be solved to rounding level.
  bool Solve(const double* b, double* z, bool transposed);

 private:
  using SparseLU = Eigen::SparseLU<Eigen::SparseMatrix<double>>;

  void Multiply(const double* x, double* y, bool transposed) const;
  bool SolveByGmres(const double* b, double* z, bool transposed);
  // One restart cycle; returns the norm of the residual that it reached.
  double GmresCycle(const double* residual, double norm, double target, double* z,
                    bool transposed);
  bool FactorizeLu();
  bool SolveByLu(const double* b, double* z, bool transposed);

  const BlockPattern& pattern_;
  std::vector<double> values_;
  std::vector<double> symmetric_values_;
  Cholesky cholesky_;
  bool symmetric_ = true;
  bool has_cholesky_ = false;
  std::unique_ptr<SparseLU> lu_;  // last resort
  bool has_lu_ = false;
  std::vector<double> basis_, work_, residual_, right_;
};

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_STEP_SOLVER_H_
