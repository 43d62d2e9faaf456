#include "integrators/linearly_implicit_euler.h"

namespace dpe {

ForceState LinearlyImplicitEuler::ExpansionPoint(const ObjectSystem& system,
                                                 const StepStates& states) {
  const int n = system.num_coordinates();
  direction_x_.resize(n);
  for (int c = 0; c < n; ++c) direction_x_[c] = states.h * states.v1[c];
  const double* delta = VelocityChange(system, states);
  direction_v_.assign(delta, delta + n);
  return {states.x0, states.v0, direction_x_.data(), direction_v_.data()};
}

StepOutcome LinearlyImplicitEuler::Step(ObjectSystem* system, const StepStates& states,
                                        double* x1, double* v1) {
  const double h = states.h;
  const int n = system->num_coordinates();
  // f + h K v0 is the expansion along (h v0, 0).
  direction_x_.resize(n);
  direction_v_.assign(n, 0.0);
  force_.resize(n);
  for (int c = 0; c < n; ++c) direction_x_[c] = h * states.v0[c];
  const ForceState point{states.x0, states.v0, direction_x_.data(),
                         direction_v_.data()};
  system->Force(point, force_.data());
  AssembleStepMatrix(system, point, h);
  free_.resize(system->pattern().num_rows());
  system->GatherFree(force_.data(), free_.data());
  for (double& value : free_) value *= h;
  StepSolver& solver = system->solver();
  if (!solver.Factorize(system->IsSymmetric()) ||
      !solver.Solve(free_.data(), free_.data(), /*transposed=*/false)) {
    return {RolloutStatus::Code::kLinearSolverFailed,
            "the step matrix M - h D - h^2 K is singular or not finite"};
  }
  const double* dv = free_.data();
  for (int i : system->free_vertices()) {
    for (int c = 3 * i; c < 3 * i + 3; ++c) {
      v1[c] = states.v0[c] + *dv++;
      x1[c] = states.x0[c] + h * v1[c];
    }
  }
  return {};
}

bool LinearlyImplicitEuler::AdjointStep(ObjectSystem* system, const StepStates& states,
                                        const StepAdjoint& adjoint) {
  const ForceState point = ExpansionPoint(*system, states);
  AssembleStepMatrix(system, point, states.h);
  if (!SolveAdjoint(system, states.h, adjoint)) return false;
  for (int i : system->free_vertices()) {
    for (int c = 3 * i; c < 3 * i + 3; ++c) {
      adjoint.gv[c] = system->parameters().mass[i] * lambda_[c];
    }
  }
  system->AddAdjoint(point, lambda_.data(), states.h, VelocityPart::kMinusPlain,
                     adjoint.gx, adjoint.gv);
  AddParameterAdjoint(*system, states, point, adjoint.gp);
  return true;
}

void LinearlyImplicitEuler::TangentStep(ObjectSystem* system, const StepStates& states,
                                        StepLinearization* out) {
  const ForceState point = ExpansionPoint(*system, states);
  out->a_is_mass = false;
  out->position_uses_new_velocity = true;
  AssembleStepMatrix(system, point, states.h);
  ClearLinearization(*system, out);
  system->AddJacobian(point, states.h, 0.0, VelocityPart::kWhole, out->rx.data());
  system->AddMass(out->rv.data());
  system->AddJacobian(point, 0.0, states.h, VelocityPart::kMinusPlain, out->rv.data());
  ListParameterEntries(*system, states, point, out);
}

}  // namespace dpe
