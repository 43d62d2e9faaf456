// Solves A z = b and A^T z = b for the matrix of one integration step, by one of two
// ways behind one interface:
//   - directly (direct_solver.h), to rounding level;
//   - for large systems, or when asked for, by a Krylov method (iterative_solver.h), to
//     a relative residual of `tolerance`, of the equations as they are and scaled by
//     their diagonal blocks, forward and backward: then derivatives are exact to that
//     tolerance. Where it fails the direct way takes over.
#ifndef DPE_ENGINE_LINEAR_STEP_SOLVER_H_
#define DPE_ENGINE_LINEAR_STEP_SOLVER_H_

#include <memory>
#include <vector>

#include "dpe/engine/timings.h"
#include "linear/block_pattern.h"
#include "linear/direct_solver.h"
#include "linear/iterative_solver.h"

namespace dpe {

// What the solvers of one object share; they take turns on one thread.
struct StepSolverContext {
  // The pattern must outlive the context.
  explicit StepSolverContext(const BlockPattern& pattern)
      : pattern(pattern),
        direct(std::make_shared<DirectSolverContext>(pattern)),
        krylov(pattern) {}

  // Bytes of a KeptFactor of a matrix.
  size_t kept_bytes(bool symmetric);

  const BlockPattern& pattern;
  std::shared_ptr<DirectSolverContext> direct;
  bool iterative = false;
  double tolerance = 1e-12;    // of the Krylov method
  Timings* timings = nullptr;  // if set, receives the time of factorising and solving
  IterativeSolver krylov;
  // Matrices are numbered as they are factorised; the one that `krylov` is prepared
  // for, or -1.
  long num_matrices = 0;
  long prepared_matrix = -1;
  bool prepared_transposed = false;
  std::vector<double> right;
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

  // The same by the direct way, whatever the context prefers.
  bool FactorizeDirectly(bool symmetric);

  bool factorized() const { return factorized_; }
  // Forgets the factorisation.
  void Reset() { factorized_ = false; }

  // Goes on with the factorisation of an earlier, nearby matrix: `values` may have
  // changed since, and iteration makes up for the difference, so solves are as exact.
  // False if the matrix cannot be factorised.
  bool KeepFactorization();

  // Until it is called with null, every factorisation goes into `kept` too; that is
  // clear where there is none worth keeping (the Krylov method's is made anew in no
  // time).
  void KeepFactorsIn(KeptFactor* kept) { direct_.KeepFactorsIn(kept); }
  // Takes such a one for the factorisation of an earlier, nearby matrix, or of the
  // same: KeepFactorization goes on with it. An empty one is no factorisation. `kept`
  // must stay as it is while it is used.
  void UseFactor(const KeptFactor* kept, bool symmetric);
  // Solves with such a one of the very matrix, whose values are not needed; false, with
  // z undefined, where only they could tell whether it is exact. z must not be b.
  bool SolveByKept(const double* b, double* z, bool transposed);

  // z = A^{-1} b, or A^{-T} b if `transposed`; b and z may be the same array. False if
  // that cannot be solved to rounding level (to the tolerance, by the Krylov method).
  //
  // @param guess     if not null, where a Krylov method starts from
  // @param accuracy  the relative residual that suffices the direct way; 0: rounding
  // level
  bool Solve(const double* b, double* z, bool transposed, const double* guess = nullptr,
             double accuracy = 0.0);

  // The factors of A for many right-hand sides, after Factorize; without values if
  // there are none that are exact (see DirectSolver).
  SupernodalFactor ExactFactor();

 private:
  bool PrepareKrylov(bool transposed);
  // Solves for context_->right.
  bool SolveByKrylov(double* z, const double* guess);

  std::shared_ptr<StepSolverContext> context_;
  const BlockPattern& pattern_;
  std::vector<double> values_;
  DirectSolver direct_;
  bool iterative_ = false;  // the matrix at hand is solved by the Krylov method
  long matrix_ = -1;        // its number
  bool factorized_ = false;
  bool symmetric_ = true;
};

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_STEP_SOLVER_H_
