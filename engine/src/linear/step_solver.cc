#include "linear/step_solver.h"

#include <algorithm>
#include <utility>

namespace dpe {
namespace {

// Up to here the default is the exact way, although at tolerance 1e-5 the iterations
// take a third of the time: what estimation compares are differences far below that.
// Beyond, the cost of a factorisation grows with the power 1.5 of the size.
constexpr int kDirectRows = 10000;

}  // namespace

bool PrefersIterativeSolver(int num_rows) { return num_rows > kDirectRows; }

size_t StepSolverContext::kept_bytes(bool symmetric) {
  return direct->structure()->num_values(symmetric) * sizeof(double);
}

StepSolver::StepSolver(std::shared_ptr<StepSolverContext> context)
    : context_(std::move(context)),
      pattern_(context_->pattern),
      values_(pattern_.num_nonzeros()),
      direct_(context_->direct) {}

bool StepSolver::Factorize(bool symmetric) {
  if (!context_->iterative) return FactorizeDirectly(symmetric);
  symmetric_ = symmetric;
  iterative_ = true;  // Solve prepares: it knows which way
  matrix_ = context_->num_matrices++;
  factorized_ = true;
  return true;
}

bool StepSolver::FactorizeDirectly(bool symmetric) {
  const ScopedTimer timer(context_->timings, TimedPart::kFactorization);
  symmetric_ = symmetric;
  iterative_ = false;
  factorized_ = direct_.Factorize(values_, symmetric_);
  return factorized_;
}

bool StepSolver::KeepFactorization() {
  if (iterative_) {
    matrix_ = context_->num_matrices++;
    return true;
  }
  return direct_.KeepFactorization(values_);
}

void StepSolver::UseFactor(const KeptFactor* kept, bool symmetric) {
  iterative_ = false;
  symmetric_ = symmetric;
  factorized_ = !kept->empty();
  if (factorized_) direct_.UseFactor(kept, symmetric);
}

bool StepSolver::SolveByKept(const double* b, double* z, bool transposed) {
  if (!factorized_ || iterative_) return false;
  const ScopedTimer timer(context_->timings, TimedPart::kSolve);
  return direct_.SolveByKept(b, z, transposed);
}

bool StepSolver::Solve(const double* b, double* z, bool transposed, const double* guess,
                       double accuracy) {
  const bool prepared = iterative_ && PrepareKrylov(transposed);
  const ScopedTimer timer(context_->timings, TimedPart::kSolve);
  if (!iterative_) return direct_.Solve(values_, b, z, transposed, accuracy);
  const int n = pattern_.num_rows();
  context_->right.assign(b, b + n);  // b and z may be the same array
  if (prepared && SolveByKrylov(z, guess)) return true;
  iterative_ = false;
  return direct_.Factorize(values_, symmetric_) &&
         direct_.Solve(values_, context_->right.data(), z, transposed);
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

SupernodalFactor StepSolver::ExactFactor() {
  if (iterative_) return {};
  return direct_.ExactFactor(values_);
}

}  // namespace dpe
