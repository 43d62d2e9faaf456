// Solves A z = b and A^T z = b to rounding level by a factorisation of A.
//
// A is nearly symmetric: only spring damping and drag make it non-symmetric, and it is
// positive definite unless springs are strongly compressed. The strategy:
//   1. it is factorised by sparse LU without pivoting (supernodal_lu.h), which is exact
//      for A and A^T alike; if A is symmetric, by its symmetric form with half the
//      work;
//   2. every solve checks its residual. Where pivoting would have been needed, or where
//      the factorisation is that of a nearby matrix (KeepFactorization), GMRES with the
//      factorisation as preconditioner brings it down to rounding level; where the
//      nearby matrix turns out not to be near, A is factorised anew;
//   3. if that fails, A is factorised by sparse LU with partial pivoting
//      (Eigen::SparseLU), many times slower.
// Each way gives the solution of the same exact system, so derivative passes are exact.
#ifndef DPE_ENGINE_LINEAR_DIRECT_SOLVER_H_
#define DPE_ENGINE_LINEAR_DIRECT_SOLVER_H_

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <memory>
#include <vector>

#include "linear/block_pattern.h"
#include "linear/kept_factor.h"
#include "linear/supernodal_lu.h"
#include "linear/supernodal_structure.h"

namespace dpe {

// What the direct solvers of one object share; they take turns on one thread.
struct DirectSolverContext {
  // The pattern must outlive the context.
  explicit DirectSolverContext(const BlockPattern& pattern) : pattern(pattern) {}

  // Made at the first use: large systems may never need it.
  const std::shared_ptr<const SupernodalStructure>& structure();

  const BlockPattern& pattern;
  std::vector<double> factorization_work, solve_work;
  std::vector<double> residual, right, basis;

 private:
  std::shared_ptr<const SupernodalStructure> structure_;
};

class DirectSolver {
 public:
  explicit DirectSolver(std::shared_ptr<DirectSolverContext> context);

  // @param values     A in pattern order
  // @param symmetric  the caller knows that A is symmetric
  // @return           false if the matrix is found to be singular; one that is not
  //                   finite may only show in Solve
  bool Factorize(const std::vector<double>& values, bool symmetric);

  // Goes on with the factorisation of an earlier, nearby matrix. False if the matrix
  // cannot be factorised.
  bool KeepFactorization(const std::vector<double>& values);

  // z = A^{-1} b, or A^{-T} b if `transposed`; b and z may be the same array. `values`
  // are those of A. False if that cannot be solved.
  //
  // @param accuracy  the relative residual that is enough; 0: rounding level
  bool Solve(const std::vector<double>& values, const double* b, double* z,
             bool transposed, double accuracy = 0.0);

  // Until it is called with null, every factorisation goes into `kept` too, which is
  // clear where there is none to keep.
  void KeepFactorsIn(KeptFactor* kept);
  // Goes on with such a one, of the matrix at hand or a nearby one; it must stay as it
  // is while it is used.
  void UseFactor(const KeptFactor* kept, bool symmetric);

  // Solves with such a one of the matrix at hand, without that matrix, where there is
  // no doubt about its residual: |b - A z| / |z| depends on the factorisation, hardly
  // on b, and was measured when it was made. False, with z undefined, where there is
  // doubt.
  //
  // @param z  must not be b
  bool SolveByKept(const double* b, double* z, bool transposed);

  // The factors of A, for many right-hand sides at once; they hold no values if A
  // itself was not factorised, or not accurately enough to do without iteration.
  SupernodalFactor ExactFactor(const std::vector<double>& values);

 private:
  using PivotedLu = Eigen::SparseLU<Eigen::SparseMatrix<double>>;
  enum class Kind { kNone, kLu, kKept, kPivotedLu };

  SupernodalFactor factor() const;
  // z with a residual as small as it gets; false if it is not small enough.
  bool SolveByFactor(const std::vector<double>& values, double* z, bool transposed,
                     double accuracy);
  bool FactorizeWithPivots(const std::vector<double>& values);
  bool SolveWithPivots(const std::vector<double>& values, const double* b, double* z,
                       bool transposed);

  std::shared_ptr<DirectSolverContext> context_;
  const BlockPattern& pattern_;
  Kind kind_ = Kind::kNone;
  bool is_exact_ = true;  // the factorisation is that of the current matrix
  bool symmetric_ = true;
  std::unique_ptr<SupernodalLu> lu_;
  KeptFactor* target_ = nullptr;      // where factorisations are kept
  const KeptFactor* kept_ = nullptr;  // the one in use
  std::unique_ptr<PivotedLu> pivoted_lu_;
};

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_DIRECT_SOLVER_H_
