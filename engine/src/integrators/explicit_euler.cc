#include "integrators/explicit_euler.h"

namespace dpe {

ForceState ExplicitEuler::ExpansionPoint(const ObjectSystem& /*system*/,
                                         const StepStates& states) {
  return {states.x0, states.v0, nullptr, nullptr};
}

StepOutcome ExplicitEuler::Step(ObjectSystem* system, const StepStates& states,
                                double* x1, double* v1) {
  force_.resize(system->num_coordinates());
  system->Force(ExpansionPoint(*system, states), force_.data());
  for (int i : system->free_vertices()) {
    const double factor = states.h / system->parameters().mass[i];
    for (int c = 3 * i; c < 3 * i + 3; ++c) {
      v1[c] = states.v0[c] + factor * force_[c];
      x1[c] = states.x0[c] + states.h * (symplectic_ ? v1[c] : states.v0[c]);
    }
  }
  return {};
}

bool ExplicitEuler::AdjointStep(ObjectSystem* system, const StepStates& states,
                                const StepAdjoint& adjoint) {
  const ForceState point = ExpansionPoint(*system, states);
  SolveAdjointMass(*system, symplectic_ ? states.h : 0.0, adjoint);
  // dL/dv0 starts from M lambda, plus h gx where v0 moved the positions.
  for (int i : system->free_vertices()) {
    for (int c = 3 * i; c < 3 * i + 3; ++c) {
      adjoint.gv[c] = system->parameters().mass[i] * lambda_[c];
      if (!symplectic_) adjoint.gv[c] += states.h * adjoint.gx[c];
    }
  }
  system->AddAdjoint(point, lambda_.data(), states.h, VelocityPart::kWhole, adjoint.gx,
                     adjoint.gv);
  AddParameterAdjoint(*system, states, point, adjoint.gp);
  return true;
}

void ExplicitEuler::TangentStep(ObjectSystem* system, const StepStates& states,
                                StepLinearization* out) {
  const ForceState point = ExpansionPoint(*system, states);
  out->a_is_mass = true;
  out->position_uses_new_velocity = symplectic_;
  ClearLinearization(*system, out);
  system->AddJacobian(point, states.h, 0.0, VelocityPart::kWhole, out->rx.data());
  system->AddMass(out->rv.data());
  system->AddJacobian(point, 0.0, states.h, VelocityPart::kWhole, out->rv.data());
  ListParameterEntries(*system, states, point, out);
}

}  // namespace dpe
