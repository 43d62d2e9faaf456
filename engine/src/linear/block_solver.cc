#include "linear/block_solver.h"

namespace dpe {

bool BlockSolver::Prepare(StepSolver* solver, bool symmetric, int num_columns) {
  solver_ = solver;
  factor_ = {};
  const bool ok = num_columns >= kMinColumnsToFactorize
                      ? solver->FactorizeDirectly(symmetric)
                      : solver->Factorize(symmetric);
  if (ok) factor_ = solver->ExactFactor();
  return ok;
}

bool BlockSolver::Solve(double* right, int count, bool transposed) const {
  if (factor_.lower == nullptr) return SolveOneByOne(right, count, transposed);
  std::vector<double> work;
  SolveSupernodalMany(transposed ? factor_.Transposed() : factor_, count, &work, right);
  return true;
}

bool BlockSolver::SolveOneByOne(double* right, int count, bool transposed) const {
  const int n = pattern_.num_rows();
  std::vector<double> b(n), z(n);
  for (int c = 0; c < count; ++c) {
    for (int r = 0; r < n; ++r) b[r] = right[static_cast<size_t>(r) * count + c];
    if (!solver_->Solve(b.data(), z.data(), transposed)) return false;
    for (int r = 0; r < n; ++r) right[static_cast<size_t>(r) * count + c] = z[r];
  }
  return true;
}

}  // namespace dpe
