#include "linear/direct_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "linear/gmres.h"
#include "linear/supernodal_solve.h"
#include "linear/symbolic_analysis.h"

namespace dpe {
namespace {

constexpr int kMaxCycles = 4;
// With the factorisation of an earlier matrix so many iterations cost about as much as
// a new factorisation, which is then the better way.
constexpr int kMaxKeptIterations = 12;
// The relative residual that counts as rounding level, and the one that is still
// accepted when the iteration can get no further.
constexpr double kTarget = 1e-13;
constexpr double kAccept = 1e-12;
// How much larger the error of a solve may be than that of another one with the same
// factorisation.
constexpr double kErrorMargin = 10.0;

using ConstVector = Eigen::Map<const Eigen::VectorXd>;
using Vector = Eigen::Map<Eigen::VectorXd>;

}  // namespace

const std::shared_ptr<const SupernodalStructure>& DirectSolverContext::structure() {
  if (!structure_) structure_ = AnalyzePattern(pattern);
  return structure_;
}

DirectSolver::DirectSolver(std::shared_ptr<DirectSolverContext> context)
    : context_(std::move(context)), pattern_(context_->pattern) {
  context_->residual.resize(pattern_.num_rows());
  context_->right.resize(pattern_.num_rows());
}

bool DirectSolver::Factorize(const std::vector<double>& values, bool symmetric) {
  is_exact_ = true;
  symmetric_ = symmetric;
  kind_ = Kind::kNone;
  if (!lu_) lu_ = std::make_unique<SupernodalLu>(context_->structure());
  if (target_ != nullptr) target_->Clear();
  if (lu_->Factorize(values.data(), symmetric, &context_->factorization_work,
                     target_ != nullptr ? &target_->panels : nullptr)) {
    kind_ = Kind::kLu;
    if (target_ != nullptr) target_->has_factor = true;
  }
  return kind_ != Kind::kNone || FactorizeWithPivots(values);
}

bool DirectSolver::KeepFactorization(const std::vector<double>& values) {
  is_exact_ = false;
  // Partial pivoting is the last resort, without an iteration that could make up.
  return kind_ != Kind::kPivotedLu || FactorizeWithPivots(values);
}

SupernodalFactor DirectSolver::factor() const {
  return kind_ == Kind::kKept ? kept_->panels.factor(*context_->structure())
                              : lu_->factor();
}

void DirectSolver::KeepFactorsIn(KeptFactor* kept) {
  if (kept != nullptr) kept->Clear();
  target_ = kept;
}

void DirectSolver::UseFactor(const KeptFactor* kept, bool symmetric) {
  kept_ = kept;
  kind_ = Kind::kKept;
  is_exact_ = false;
  symmetric_ = symmetric;
}

bool DirectSolver::SolveByKept(const double* b, double* z, bool transposed) {
  if (kind_ != Kind::kKept || kept_->error < 0.0) return false;
  const int n = pattern_.num_rows();
  std::copy_n(b, n, z);
  SolveSupernodal(transposed ? factor().Transposed() : factor(), &context_->solve_work,
                  z);
  return kErrorMargin * kept_->error * ConstVector(z, n).norm() <=
         kAccept * ConstVector(b, n).norm();
}

bool DirectSolver::Solve(const std::vector<double>& values, const double* b, double* z,
                         bool transposed, double accuracy) {
  const int n = pattern_.num_rows();
  if (kind_ == Kind::kPivotedLu) return SolveWithPivots(values, b, z, transposed);
  if (b != context_->right.data()) {  // b and z may be the same array
    std::copy_n(b, n, context_->right.data());
  }
  if (SolveByFactor(values, z, transposed, accuracy)) return true;
  if (!is_exact_ && Factorize(values, symmetric_)) {
    return Solve(values, context_->right.data(), z, transposed, accuracy);
  }
  return FactorizeWithPivots(values) &&
         SolveWithPivots(values, context_->right.data(), z, transposed);
}

bool DirectSolver::SolveByFactor(const std::vector<double>& values, double* z,
                                 bool transposed, double accuracy) {
  const int n = pattern_.num_rows();
  const ConstVector right(context_->right.data(), n);
  Vector residual(context_->residual.data(), n);
  const SupernodalFactor lu = transposed ? factor().Transposed() : factor();
  const auto precondition = [&](const double* x, double* y) {
    std::copy_n(x, n, y);
    SolveSupernodal(lu, &context_->solve_work, y);
  };
  const auto multiply = [&](const double* x, double* y) {
    pattern_.Multiply(values.data(), transposed, x, y);
  };
  const double scale = right.norm();
  if (!std::isfinite(scale)) return false;
  Vector(z, n).setZero();
  if (scale == 0.0) return true;
  precondition(right.data(), z);
  const double target = std::max(accuracy, kTarget) * scale;
  const int iterations = is_exact_ ? kMaxGmresIterations : kMaxKeptIterations;
  double norm = scale;
  for (int cycle = 0;; ++cycle) {
    multiply(z, residual.data());
    residual = right - residual;
    const double previous = norm;
    norm = residual.norm();
    if (cycle == 0 && target_ != nullptr && kind_ == Kind::kLu && is_exact_ &&
        target_->error < 0.0 && norm <= kTarget * scale) {
      target_->error = std::max(norm, std::numeric_limits<double>::epsilon() * scale) /
                       Vector(z, n).norm();
    }
    if (norm <= target) return true;
    // When a cycle gains little, rounding level is reached; the first solve gains
    // little where it is that of another matrix.
    if (cycle == (is_exact_ ? kMaxCycles : 1) || !std::isfinite(norm)) break;
    if (cycle > 0 && !(norm < 0.3 * previous)) break;
    if (!GmresCycle(n, residual.data(), norm, target, iterations, multiply,
                    precondition, &context_->basis, z)) {
      break;
    }
  }
  return norm <= std::max(accuracy, kAccept) * scale;
}

SupernodalFactor DirectSolver::ExactFactor(const std::vector<double>& values) {
  if (kind_ == Kind::kPivotedLu || !is_exact_) return {};
  const int n = pattern_.num_rows();
  Vector test(context_->right.data(), n), residual(context_->residual.data(), n);
  for (int i = 0; i < n; ++i) test[i] = i % 2 == 0 ? 1.0 : -0.5;
  std::vector<double>& solution = context_->basis;
  solution.resize(std::max<size_t>(solution.size(), n));
  std::copy_n(test.data(), n, solution.data());
  SolveSupernodal(factor(), &context_->solve_work, solution.data());
  pattern_.Multiply(values.data(), solution.data(), residual.data());
  if (!((test - residual).norm() <= kAccept * test.norm())) return {};
  return factor();
}

bool DirectSolver::FactorizeWithPivots(const std::vector<double>& values) {
  const int n = pattern_.num_rows();
  kind_ = Kind::kNone;
  if (target_ != nullptr) target_->Clear();
  if (!ConstVector(values.data(), static_cast<int>(values.size())).allFinite()) {
    return false;
  }
  const Eigen::Map<const Eigen::SparseMatrix<double>> matrix(
      n, n, pattern_.num_nonzeros(), pattern_.column_starts().data(),
      pattern_.row_indices().data(), values.data());
  if (!pivoted_lu_) {
    pivoted_lu_ = std::make_unique<PivotedLu>();
    pivoted_lu_->analyzePattern(matrix);
  }
  pivoted_lu_->factorize(matrix);
  if (pivoted_lu_->info() == Eigen::Success) kind_ = Kind::kPivotedLu;
  return kind_ == Kind::kPivotedLu;
}

bool DirectSolver::SolveWithPivots(const std::vector<double>& values, const double* b,
                                   double* z, bool transposed) {
  const int n = pattern_.num_rows();
  const auto solve = [&](const Eigen::VectorXd& right) -> Eigen::VectorXd {
    if (transposed) return pivoted_lu_->transpose().solve(right);
    return pivoted_lu_->solve(right);
  };
  const Eigen::VectorXd right = ConstVector(b, n);
  Eigen::VectorXd solution = solve(right);
  pattern_.Multiply(values.data(), transposed, solution.data(),
                    context_->residual.data());
  // One step of refinement.
  solution += solve(right - ConstVector(context_->residual.data(), n));
  Vector(z, n) = solution;
  return solution.allFinite();
}

}  // namespace dpe
