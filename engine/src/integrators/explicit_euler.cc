#include "integrators/explicit_euler.h"

namespace dpe {

ForceState ExplicitEuler::ExpansionPoint(const ObjectSystem& /*system*/,
                                         const StepStates& states) {
  return {states.x0, states.v0, nullptr, nullptr};
}

StepOutcome ExplicitEuler::Step(ObjectSystem* system, StepSolver* /*solver*/,
                                const StepStates& states, const StepResult& result) {
  force_.resize(system->num_coordinates());
  system->Force(ExpansionPoint(*system, states), force_.data());
  for (int i : system->free_vertices()) {
    const double factor = states.h / system->parameters().mass[i];
    for (int c = 3 * i; c < 3 * i + 3; ++c) {
      result.v1[c] = states.v0[c] + factor * force_[c];
      result.x1[c] =
          states.x0[c] + states.h * (symplectic_ ? result.v1[c] : states.v0[c]);
    }
  }
  return {};
}

bool ExplicitEuler::AdjointStep(ObjectSystem* system, StepSolver* /*solver*/,
                                const StepStates& states, const StepAdjoint& adjoint) {
  const ForceState point = ExpansionPoint(*system, states);
  SetMu(*system, symplectic_ ? states.h : 0.0, adjoint);
  // With A = M, M lambda = mu; where v0 moved the positions it receives h gx as well.
  for (int i : system->free_vertices()) {
    for (int c = 3 * i; c < 3 * i + 3; ++c) {
      adjoint.gv[c] = lambda_[c];
      if (!symplectic_) adjoint.gv[c] += states.h * adjoint.gx[c];
      lambda_[c] /= system->parameters().mass[i];
    }
  }
  system->AddStepAdjoint(point, lambda_.data(), states.h, VelocityPart::kWhole,
                         Difference(*system, states.v0, states.v1), adjoint.gx,
                         adjoint.gv, adjoint.gp);
  return true;
}

void ExplicitEuler::TangentStage(int /*stage*/, ObjectSystem* system,
                                 StepSolver* /*solver*/, const StepStates& states,
                                 StageLinearization* out) {
  const ForceState point = ExpansionPoint(*system, states);
  out->a_is_mass = true;
  out->p = symplectic_ ? 0.0 : states.h;
  out->c = symplectic_ ? states.h : 0.0;
  ClearLinearization(*system, out);
  system->AddJacobian(point, states.h, 0.0, VelocityPart::kWhole, out->rx.data());
  system->AddMass(out->rv.data());
  system->AddJacobian(point, 0.0, states.h, VelocityPart::kWhole, out->rv.data());
  ListParameterEntries(*system, point, states.h,
                       Difference(*system, states.v0, states.v1), out);
}

}  // namespace dpe
