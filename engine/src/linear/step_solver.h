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
//
// For large systems, or when asked for, A z = b is solved by a Krylov method instead
// (iterative_solver.h), to a relative residual of `tolerance`, forward and backward:
// then derivatives are exact to that tolerance. Where that fails the way above takes
// over.
#ifndef DPE_ENGINE_LINEAR_STEP_SOLVER_H_
#define DPE_ENGINE_LINEAR_STEP_SOLVER_H_

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <memory>
#include <vector>

#include "dpe/engine/timings.h"
#include "linear/block_pattern.h"
#include "linear/cholesky.h"
#include "linear/iterative_solver.h"

namespace dpe {

// What the solvers of one object share; they take turns on one thread.
struct StepSolverContext {
  // The pattern must outlive the context.
  explicit StepSolverContext(const BlockPattern& pattern)
      : pattern(pattern), krylov(pattern) {}

  // Bytes that a factorised StepSolver takes.
  size_t solver_bytes();
  // Made at the first use: large systems may never need it.
  const std::shared_ptr<CholeskyAnalysis>& analysis();

  const BlockPattern& pattern;
  bool iterative = false;
  double tolerance = 1e-12;    // of the Krylov method
  Timings* timings = nullptr;  // if set, receives the time of factorising and solving
  IterativeSolver krylov;
  // Matrices are numbered as they are factorised; the one that `krylov` is prepared for,
  // or -1.
  long num_matrices = 0;
  long prepared_matrix = -1;
  bool prepared_transposed = false;
  std::vector<double> symmetric_values;
  std::vector<double> basis, work, residual, right;  // of GMRES

 private:
  std::shared_ptr<CholeskyAnalysis> analysis_;
};

// Whether "auto" takes the Krylov method for this many unknowns.
bool PrefersIterativeSolver(int num_rows);

class StepSolver {
 public:
  explicit StepSolver(std::shared_ptr<StepSolverContext> context);

  // Where the caller assembles A before Factorize.
  std::vector<double>& values() { return values_; }
  const std::vector<double>& values() const { return values_; }

  // @param symmetric  the caller knows that A is symmetric
  // @return           false if the matrix is found to be singular; one that is not
  //                   finite may only show in Solve
  bool Factorize(bool symmetric);

  bool factorized() const { return factorized_; }
  // Forgets the factorisation.
  void Reset() { factorized_ = false; }

  // Goes on with the factorisation of an earlier, nearby matrix: `values` may have
  // changed since, and GMRES makes up for the difference, so solves are as exact. False
  // if the matrix cannot be factorised.
  bool KeepFactorization();

  // z = A^{-1} b, or A^{-T} b if `transposed`; b and z may be the same array. False if
  // that cannot be solved to rounding level (to the tolerance, by the Krylov method).
  //
  // @param guess  if not null, where a Krylov method starts from
  bool Solve(const double* b, double* z, bool transposed,
             const double* guess = nullptr);

 private:
  using SparseLU = Eigen::SparseLU<Eigen::SparseMatrix<double>>;

  bool FactorizeDirectly();
  bool SolveDirectly(const double* b, double* z, bool transposed);
  bool PrepareKrylov(bool transposed);
  // Solves for context_->right.
  bool SolveByKrylov(double* z, const double* guess);
  void Multiply(const double* x, double* y, bool transposed) const;
  bool SolveByGmres(const double* b, double* z, bool transposed);
  // One restart cycle; returns the norm of the residual that it reached.
  double GmresCycle(const double* residual, double norm, double target, double* z,
                    bool transposed);
  bool FactorizeLu();
  bool SolveByLu(const double* b, double* z, bool transposed);

  std::shared_ptr<StepSolverContext> context_;
  const BlockPattern& pattern_;
  std::vector<double> values_;
  std::unique_ptr<Cholesky> cholesky_;
  bool iterative_ = false;  // the matrix at hand is solved by the Krylov method
  long matrix_ = -1;        // its number
  bool factorized_ = false;
  bool symmetric_ = true;
  std::unique_ptr<SparseLU> lu_;  // last resort
  bool has_lu_ = false;
};

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_STEP_SOLVER_H_
