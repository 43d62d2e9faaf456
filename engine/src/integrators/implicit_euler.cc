#include "integrators/implicit_euler.h"

namespace dpe {

ForceState ImplicitEuler::ExpansionPoint(const ObjectSystem& /*system*/,
                                         const StepStates& states) {
  return {states.x1, states.v1, nullptr, nullptr};
}

StepOutcome ImplicitEuler::Step(ObjectSystem* system, StepSolver* solver,
                                const StepStates& states, const StepResult& result) {
  solver->Reset();
  momentum_.assign(system->num_coordinates(), 0.0);
  for (int i : system->free_vertices()) {
    for (int c = 3 * i; c < 3 * i + 3; ++c) {
      momentum_[c] = system->parameters().mass[i] * states.v0[c];
      result.v1[c] = states.v0[c];
    }
  }
  return stage_.Solve(system, solver, states.h, states.x0, momentum_.data(), result.x1,
                      result.v1);
}

bool ImplicitEuler::AdjointStep(ObjectSystem* system, StepSolver* solver,
                                const StepStates& states, const StepAdjoint& adjoint) {
  const ForceState point = ExpansionPoint(*system, states);
  SetMu(*system, states.h, adjoint);
  system->AssembleStepMatrix(states.x1, states.v1, states.h, &solver->values());
  if (!PrepareSolver(*system, solver) || !SolveAdjoint(*system, solver)) return false;
  system->AddStepAdjoint(point, lambda_.data(), states.h, VelocityPart::kWhole,
                         Difference(*system, states.v0, states.v1), adjoint.gx,
                         /*gv=*/nullptr, adjoint.gp);
  for (int i : system->free_vertices()) {
    for (int c = 3 * i; c < 3 * i + 3; ++c) {
      adjoint.gv[c] = system->parameters().mass[i] * lambda_[c];
    }
  }
  return true;
}

void ImplicitEuler::TangentStage(int /*stage*/, ObjectSystem* system,
                                 StepSolver* solver, const StepStates& states,
                                 StageLinearization* out) {
  const ForceState point = ExpansionPoint(*system, states);
  out->c = states.h;
  system->AssembleStepMatrix(states.x1, states.v1, states.h, &solver->values());
  ClearLinearization(*system, out);
  system->AddJacobian(point, states.h, 0.0, VelocityPart::kWhole, out->rx.data());
  system->AddMass(out->rv.data());
  ListParameterEntries(*system, point, states.h,
                       Difference(*system, states.v0, states.v1), out);
}

}  // namespace dpe
