#include "linear/step_solver.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dpe {
namespace {

constexpr int kRestart = 30;
constexpr int kMaxCycles = 4;
// The relative residual that counts as rounding level, and the one that is still
// accepted when the iteration can get no further.
constexpr double kTarget = 1e-14;
constexpr double kAccept = 1e-12;

// Up to here the default is the exact way, although at tolerance 1e-5 the iterations
// take a third of the time: what estimation compares are differences far below that.
// Beyond, the cost of a factorisation grows with the power 1.5 of the size.
constexpr int kDirectRows = 10000;

using ConstVector = Eigen::Map<const Eigen::VectorXd>;
using Vector = Eigen::Map<Eigen::VectorXd>;

}  // namespace

bool PrefersIterativeSolver(int num_rows) { return num_rows > kDirectRows; }

const std::shared_ptr<CholeskyAnalysis>& StepSolverContext::analysis() {
  if (!analysis_) analysis_ = std::make_shared<CholeskyAnalysis>(pattern);
  return analysis_;
}

size_t StepSolverContext::solver_bytes() {
  const size_t values = pattern.num_nonzeros() * sizeof(double);
  if (iterative) return values;
  return values + analysis()->factor_bytes();
}

StepSolver::StepSolver(std::shared_ptr<StepSolverContext> context)
    : context_(std::move(context)),
      pattern_(context_->pattern),
      values_(pattern_.num_nonzeros()) {
  context_->work.resize(pattern_.num_rows());
  context_->residual.resize(pattern_.num_rows());
}

bool StepSolver::Factorize(bool symmetric) {
  const ScopedTimer timer(context_->timings, TimedPart::kFactorization);
  symmetric_ = symmetric;
  iterative_ = context_->iterative;
  matrix_ = context_->num_matrices++;
  factorized_ = iterative_ || FactorizeDirectly();
  return factorized_;
}

bool StepSolver::FactorizeDirectly() {
  has_lu_ = false;
  const double* s = values_.data();
  if (!symmetric_) {
    // Only the lower triangle of S is read.
    std::vector<double>& symmetric_values = context_->symmetric_values;
    symmetric_values.resize(values_.size());
    const std::vector<int>& mirror = pattern_.transposed_index();
    for (size_t k = 0; k < values_.size(); ++k) {
      symmetric_values[k] = 0.5 * (values_[k] + values_[mirror[k]]);
    }
    s = symmetric_values.data();
  }
  if (!cholesky_) cholesky_ = std::make_unique<Cholesky>(context_->analysis());
  return cholesky_->Factorize(s) || FactorizeLu();
}

bool StepSolver::KeepFactorization() {
  if (iterative_) {
    matrix_ = context_->num_matrices++;
    return true;
  }
  symmetric_ = false;
  return !has_lu_ || FactorizeLu();  // LU has no iteration that could make up
}

bool StepSolver::Solve(const double* b, double* z, bool transposed,
                       const double* guess) {
  const bool prepared = iterative_ && PrepareKrylov(transposed);
  const ScopedTimer timer(context_->timings, TimedPart::kSolve);
  if (!iterative_) return SolveDirectly(b, z, transposed);
  const int n = pattern_.num_rows();
  context_->right.assign(b, b + n);  // b and z may be the same array
  if (prepared && SolveByKrylov(z, guess)) return true;
  iterative_ = false;
  return FactorizeDirectly() && SolveDirectly(context_->right.data(), z, transposed);
}

bool StepSolver::PrepareKrylov(bool transposed) {
  StepSolverContext& context = *context_;
  if (context.prepared_matrix == matrix_ && context.prepared_transposed == transposed) {
    return true;
  }
  const ScopedTimer timer(context.timings, TimedPart::kFactorization);
  context.prepared_matrix = -1;
  if (!context.krylov.Prepare(values_, transposed)) return false;
  context.prepared_matrix = matrix_;
  context.prepared_transposed = transposed;
  return true;
}

bool StepSolver::SolveByKrylov(double* z, const double* guess) {
  const int n = pattern_.num_rows();
  if (guess != nullptr) {
    std::copy_n(guess, n, z);
  } else {
    std::fill_n(z, n, 0.0);
  }
  return context_->krylov.Solve(context_->tolerance, context_->right.data(), z)
      .converged;
}

bool StepSolver::SolveDirectly(const double* b, double* z, bool transposed) {
  if (has_lu_) return SolveByLu(b, z, transposed);
  if (symmetric_) {
    cholesky_->Solve(b, z);
    return ConstVector(z, pattern_.num_rows()).allFinite();
  }
  if (SolveByGmres(b, z, transposed)) return true;
  return FactorizeLu() && SolveByLu(context_->right.data(), z, transposed);
}

void StepSolver::Multiply(const double* x, double* y, bool transposed) const {
  if (transposed) {
    pattern_.MultiplyTransposed(values_.data(), x, y);
  } else {
    pattern_.Multiply(values_.data(), x, y);
  }
}

bool StepSolver::SolveByGmres(const double* b, double* z, bool transposed) {
  const int n = pattern_.num_rows();
  context_->right.assign(b, b + n);  // b and z may be the same array
  const ConstVector right(context_->right.data(), n);
  const double scale = right.norm();
  Vector(z, n).setZero();
  if (scale == 0.0) return true;
  if (!std::isfinite(scale)) return false;
  Vector residual(context_->residual.data(), n);
  residual = right;
  double norm = scale;
  for (int cycle = 0; cycle < kMaxCycles; ++cycle) {
    GmresCycle(context_->residual.data(), norm, kTarget * scale, z, transposed);
    Multiply(z, context_->work.data(), transposed);
    residual = right - ConstVector(context_->work.data(), n);
    const double previous = norm;
    norm = residual.norm();
    if (norm <= kTarget * scale) return true;
    // A second cycle corrects what rounding left in the first; when it gains little,
    // rounding level is reached.
    if (!(norm < 0.3 * previous)) break;
  }
  return norm <= kAccept * scale;
}

double StepSolver::GmresCycle(const double* residual, double norm, double target,
                              double* z, bool transposed) {
  const int n = pattern_.num_rows();
  context_->basis.resize(static_cast<size_t>(2 * kRestart + 1) * n);
  double hessenberg[kRestart + 1][kRestart];
  double cosine[kRestart], sine[kRestart], g[kRestart + 1];
  const auto column = [&](int j) {
    return Vector(context_->basis.data() + static_cast<size_t>(j) * n, n);
  };
  const auto preconditioned = [&](int j) { return column(kRestart + 1 + j); };
  column(0) = ConstVector(residual, n) / norm;
  g[0] = norm;
  int used = 0;
  for (int j = 0; j < kRestart; ++j) {
    cholesky_->Solve(column(j).data(), preconditioned(j).data());
    Multiply(preconditioned(j).data(), column(j + 1).data(), transposed);
    for (int i = 0; i <= j; ++i) {
      hessenberg[i][j] = column(i).dot(column(j + 1));
      column(j + 1) -= hessenberg[i][j] * column(i);
    }
    const double height = column(j + 1).norm();
    for (int i = 0; i < j; ++i) {
      const double upper = hessenberg[i][j];
      hessenberg[i][j] = cosine[i] * upper + sine[i] * hessenberg[i + 1][j];
      hessenberg[i + 1][j] = cosine[i] * hessenberg[i + 1][j] - sine[i] * upper;
    }
    const double length = std::hypot(hessenberg[j][j], height);
    if (!(length > 0.0) || !std::isfinite(length)) break;
    cosine[j] = hessenberg[j][j] / length;
    sine[j] = height / length;
    hessenberg[j][j] = length;
    g[j + 1] = -sine[j] * g[j];
    g[j] *= cosine[j];
    used = j + 1;
    if (std::abs(g[j + 1]) <= target || height == 0.0) break;
    column(j + 1) /= height;
  }
  // z += S^{-1} V y with H y = g; S^{-1} V was kept, which saves a solve.
  double y[kRestart];
  for (int i = used - 1; i >= 0; --i) {
    y[i] = g[i];
    for (int k = i + 1; k < used; ++k) y[i] -= hessenberg[i][k] * y[k];
    y[i] /= hessenberg[i][i];
  }
  for (int i = 0; i < used; ++i) Vector(z, n) += y[i] * preconditioned(i);
  return used > 0 ? std::abs(g[used]) : norm;
}

bool StepSolver::FactorizeLu() {
  const int n = pattern_.num_rows();
  if (!ConstVector(values_.data(), static_cast<int>(values_.size())).allFinite()) {
    return false;
  }
  const Eigen::Map<const Eigen::SparseMatrix<double>> matrix(
      n, n, pattern_.num_nonzeros(), pattern_.column_starts().data(),
      pattern_.row_indices().data(), values_.data());
  if (!lu_) {
    lu_ = std::make_unique<SparseLU>();
    lu_->analyzePattern(matrix);
  }
  lu_->factorize(matrix);
  has_lu_ = lu_->info() == Eigen::Success;
  return has_lu_;
}

bool StepSolver::SolveByLu(const double* b, double* z, bool transposed) {
  const int n = pattern_.num_rows();
  const auto solve = [&](const Eigen::VectorXd& right) -> Eigen::VectorXd {
    if (transposed) return lu_->transpose().solve(right);
    return lu_->solve(right);
  };
  const Eigen::VectorXd right = ConstVector(b, n);
  Eigen::VectorXd solution = solve(right);
  Multiply(solution.data(), context_->work.data(), transposed);
  solution += solve(right - ConstVector(context_->work.data(), n));  // one refinement
  Vector(z, n) = solution;
  return solution.allFinite();
}

}  // namespace dpe
