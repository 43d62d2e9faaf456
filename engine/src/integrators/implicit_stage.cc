#include "integrators/implicit_stage.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace dpe {
namespace {

// Near the solution a Newton step squares the error. One that falls short of this
// factor has met rounding, and below this fraction of the residual's largest term, or
// near the level of rounding, that counts as converged: sums over many springs leave
// 1e-13 to 1e-11 of it, more on larger cloths, and much more where large forces cancel.
constexpr double kStagnationFactor = 0.25;
constexpr double kStagnationTolerance = 1e-9;
constexpr int kMaxHalvings = 30;

// Newton's matrix is exact, but its system is solved to this relative residual only,
// with the factorisation of the step's first iterate as preconditioner: an iteration
// reduces the residual by the square of its size or by this factor, whichever is less.
constexpr double kNewtonStepAccuracy = 1e-6;

// The most pieces that continuation cuts c into, and the residual, relative to its
// largest term, that is enough on the way.
constexpr int kMaxPieces = 16;
constexpr double kContinuationTolerance = 1e-6;

StepOutcome NewtonFailure(const char* what, double residual, double scale) {
  char buffer[160];
  std::snprintf(buffer, sizeof(buffer), "%s (residual %.3g kg m/s, its terms %.3g)",
                what, residual, scale);
  return {RolloutStatus::Code::kNewtonFailed, buffer};
}

}  // namespace

double ImplicitStage::Residual() {
  for (int i : system_->free_vertices()) {
    for (int k = 3 * i; k < 3 * i + 3; ++k) x_[k] = x_in_[k] + c_ * v_[k];
  }
  system_->Force({x_, v_, nullptr, nullptr}, force_.data());
  double sum = 0.0, inertia_sum = 0.0, force_sum = 0.0;
  for (int i : system_->free_vertices()) {
    const double m = system_->parameters().mass[i];
    for (int k = 3 * i; k < 3 * i + 3; ++k) {
      residual_[k] = m * v_[k] - momentum_[k] - c_ * force_[k];
      sum += residual_[k] * residual_[k];
      inertia_sum += m * m * v_[k] * v_[k] + momentum_[k] * momentum_[k];
      force_sum += c_ * c_ * force_[k] * force_[k];
    }
  }
  scale_ = std::sqrt(std::max(inertia_sum, force_sum));
  return std::sqrt(sum);
}

bool ImplicitStage::NewtonStep() {
  std::vector<double>& values = solver_->values();
  system_->AssembleStepMatrix(x_, v_, c_, &values);
  system_->GatherFree(residual_.data(), free_.data());
  for (double& value : free_) value = -value;
  rounding_ = RoundingLevel(values.data());
  const bool ready = solver_->factorized() ? solver_->KeepFactorization()
                                           : solver_->Factorize(system_->IsSymmetric());
  return ready && solver_->Solve(free_.data(), free_.data(), /*transposed=*/false,
                                 /*guess=*/nullptr, kNewtonStepAccuracy);
}

double ImplicitStage::RoundingLevel(const double* values) const {
  const std::vector<BlockSlot>& diagonal = system_->diagonal();
  double sum = 0.0;
  for (int node = 0; node < system_->pattern().num_nodes(); ++node) {
    const BlockSlot& slot = diagonal[node];
    const int k = 3 * system_->free_vertices()[node];
    const double contact = c_ * system_->ContactTerms(x_ + k);
    for (int c = 0; c < 3; ++c) {
      const double level = values[slot.offset + c * slot.stride + c] *
                               (std::abs(x_[k + c]) / c_ + std::abs(v_[k + c])) +
                           contact;
      sum += level * level;
    }
  }
  return std::numeric_limits<double>::epsilon() * std::sqrt(sum);
}

bool ImplicitStage::LineSearch(double* norm) {
  start_.assign(v_, v_ + system_->num_coordinates());
  double t = 1.0;
  for (int halving = 0; halving < kMaxHalvings; ++halving, t *= 0.5) {
    const double* step = free_.data();
    for (int i : system_->free_vertices()) {
      for (int k = 3 * i; k < 3 * i + 3; ++k) v_[k] = start_[k] + t * *step++;
    }
    const double trial = Residual();
    if (std::isfinite(trial) && trial <= (1.0 - 1e-4 * t) * *norm) {
      *norm = trial;
      return true;
    }
  }
  std::copy(start_.begin(), start_.end(), v_);
  *norm = Residual();
  return false;
}

StepOutcome ImplicitStage::Newton(double tolerance) {
  double norm = Residual();
  for (int iteration = 0; iteration < options_.max_newton_iterations; ++iteration) {
    if (!std::isfinite(norm)) {
      return {RolloutStatus::Code::kNotFinite, "the forces are not finite"};
    }
    if (norm <= tolerance * scale_ || norm == 0.0) return {};
    if (!NewtonStep()) {
      return {RolloutStatus::Code::kLinearSolverFailed,
              "Newton's matrix is singular or not finite"};
    }
    const double norm_before = norm;
    const bool falls = LineSearch(&norm);
    const double small = std::max(kStagnationTolerance * scale_, 8.0 * rounding_);
    if (norm <= small && !(norm < kStagnationFactor * norm_before)) return {};
    if (!falls) {
      return NewtonFailure("Newton's line search found no decrease", norm, scale_);
    }
  }
  return NewtonFailure("Newton's method did not converge", norm, scale_);
}

bool ImplicitStage::Continuation(double c, int pieces) {
  const int n = system_->num_coordinates();
  std::copy(guess_.begin(), guess_.end(), v_);
  before_ = guess_;
  for (int piece = 1; piece <= pieces; ++piece) {
    c_ = c * piece / pieces;
    // On from the line through the last two solutions.
    for (int k = 0; piece > 2 && k < n; ++k) {
      const double last = v_[k];
      v_[k] += last - before_[k];
      before_[k] = last;
    }
    if (piece == 2) before_.assign(v_, v_ + n);
    solver_->Reset();
    if (!Newton(piece < pieces ? kContinuationTolerance : options_.newton_tolerance)
             .ok()) {
      return false;
    }
  }
  return true;
}

StepOutcome ImplicitStage::Solve(ObjectSystem* system, StepSolver* solver, double c,
                                 const double* x_in, const double* momentum, double* x,
                                 double* v) {
  system_ = system;
  solver_ = solver;
  c_ = c;
  x_in_ = x_in;
  momentum_ = momentum;
  x_ = x;
  v_ = v;
  residual_.assign(system->num_coordinates(), 0.0);
  force_.resize(system->num_coordinates());
  free_.resize(system->pattern().num_rows());
  guess_.assign(v, v + system->num_coordinates());
  const StepOutcome outcome = Newton(options_.newton_tolerance);
  if (outcome.ok()) return outcome;
  for (int pieces = 2; pieces <= kMaxPieces; pieces *= 2) {
    if (Continuation(c, pieces)) return {};
  }
  return outcome;
}

}  // namespace dpe
