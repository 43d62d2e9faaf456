#include "integrators/implicit_euler.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace dpe {
namespace {

// Where the residual no longer falls, this fraction of its largest term is still taken
// as converged to rounding: differences of large spring forces leave that much.
constexpr double kStagnationTolerance = 1e-9;
constexpr int kMaxHalvings = 30;

std::string Describe(const char* what, double residual, double scale) {
  char buffer[160];
  std::snprintf(buffer, sizeof(buffer), "%s (residual %.3g kg m/s, its terms %.3g)",
                what, residual, scale);
  return buffer;
}

}  // namespace

ForceState ImplicitEuler::ExpansionPoint(const ObjectSystem& /*system*/,
                                         const StepStates& states) {
  return {states.x1, states.v1, nullptr, nullptr};
}

double ImplicitEuler::Residual(ObjectSystem* system, const StepStates& states,
                               double* x1, const double* v1, double* scale) {
  const double h = states.h;
  for (int i : system->free_vertices()) {
    for (int c = 3 * i; c < 3 * i + 3; ++c) x1[c] = states.x0[c] + h * v1[c];
  }
  system->Force({x1, v1, nullptr, nullptr}, force_.data());
  double sum = 0.0, inertia_sum = 0.0, force_sum = 0.0;
  for (int i : system->free_vertices()) {
    const double m = system->parameters().mass[i];
    for (int c = 3 * i; c < 3 * i + 3; ++c) {
      const double inertia = m * (v1[c] - states.v0[c]);
      residual_[c] = inertia - h * force_[c];
      sum += residual_[c] * residual_[c];
      inertia_sum += m * m * (v1[c] * v1[c] + states.v0[c] * states.v0[c]);
      force_sum += h * h * force_[c] * force_[c];
    }
  }
  *scale = std::sqrt(std::max(inertia_sum, force_sum));
  return std::sqrt(sum);
}

bool ImplicitEuler::LineSearch(ObjectSystem* system, const StepStates& states,
                               double* x1, double* v1, double* norm, double* scale) {
  start_.assign(v1, v1 + system->num_coordinates());
  double t = 1.0;
  for (int k = 0; k < kMaxHalvings; ++k, t *= 0.5) {
    const double* step = free_.data();
    for (int i : system->free_vertices()) {
      for (int c = 3 * i; c < 3 * i + 3; ++c) v1[c] = start_[c] + t * *step++;
    }
    double trial_scale = 0.0;
    const double trial = Residual(system, states, x1, v1, &trial_scale);
    if (std::isfinite(trial) && trial <= (1.0 - 1e-4 * t) * *norm) {
      *norm = trial;
      *scale = trial_scale;
      return true;
    }
  }
  std::copy(start_.begin(), start_.end(), v1);
  *norm = Residual(system, states, x1, v1, scale);
  return false;
}

StepOutcome ImplicitEuler::Step(ObjectSystem* system, const StepStates& states,
                                double* x1, double* v1) {
  const int n = system->num_coordinates();
  residual_.assign(n, 0.0);
  force_.resize(n);
  free_.resize(system->pattern().num_rows());
  for (int i : system->free_vertices()) {
    for (int c = 3 * i; c < 3 * i + 3; ++c) v1[c] = states.v0[c];
  }
  double scale = 0.0;
  double norm = Residual(system, states, x1, v1, &scale);
  for (int iteration = 0; iteration < options_.max_newton_iterations; ++iteration) {
    if (!std::isfinite(norm)) {
      return {RolloutStatus::Code::kNotFinite, "the forces are not finite"};
    }
    if (norm <= options_.newton_tolerance * scale || norm == 0.0) return {};
    AssembleStepMatrix(system, {x1, v1, nullptr, nullptr}, states.h);
    system->GatherFree(residual_.data(), free_.data());
    for (double& value : free_) value = -value;
    StepSolver& solver = system->solver();
    if (!solver.Factorize(system->IsSymmetric()) ||
        !solver.Solve(free_.data(), free_.data(), /*transposed=*/false)) {
      return {RolloutStatus::Code::kLinearSolverFailed,
              "Newton's matrix M - h D - h^2 K is singular or not finite"};
    }
    if (!LineSearch(system, states, x1, v1, &norm, &scale)) {
      if (norm <= kStagnationTolerance * scale) return {};
      return {RolloutStatus::Code::kNewtonFailed,
              Describe("Newton's line search found no decrease", norm, scale)};
    }
  }
  return {RolloutStatus::Code::kNewtonFailed,
          Describe("Newton's method did not converge", norm, scale)};
}

bool ImplicitEuler::AdjointStep(ObjectSystem* system, const StepStates& states,
                                const StepAdjoint& adjoint) {
  const ForceState point = ExpansionPoint(*system, states);
  AssembleStepMatrix(system, point, states.h);
  if (!SolveAdjoint(system, states.h, adjoint)) return false;
  residual_.resize(system->num_coordinates());  // receives the unused D^T lambda
  system->AddAdjoint(point, lambda_.data(), states.h, VelocityPart::kWhole, adjoint.gx,
                     residual_.data());
  for (int i : system->free_vertices()) {
    for (int c = 3 * i; c < 3 * i + 3; ++c) {
      adjoint.gv[c] = system->parameters().mass[i] * lambda_[c];
    }
  }
  AddParameterAdjoint(*system, states, point, adjoint.gp);
  return true;
}

void ImplicitEuler::TangentStep(ObjectSystem* system, const StepStates& states,
                                StepLinearization* out) {
  const ForceState point = ExpansionPoint(*system, states);
  out->a_is_mass = false;
  out->position_uses_new_velocity = true;
  AssembleStepMatrix(system, point, states.h);
  ClearLinearization(*system, out);
  system->AddJacobian(point, states.h, 0.0, VelocityPart::kWhole, out->rx.data());
  system->AddMass(out->rv.data());
  ListParameterEntries(*system, states, point, out);
}

}  // namespace dpe
