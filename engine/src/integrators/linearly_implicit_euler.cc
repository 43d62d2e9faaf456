#include "integrators/linearly_implicit_euler.h"

namespace dpe {

ForceState LinearlyImplicitEuler::ExpansionPoint(const ObjectSystem& system,
                                                 const StepStates& states) {
  const int n = system.num_coordinates();
  direction_x_.resize(n);
  for (int c = 0; c < n; ++c) direction_x_[c] = states.h * states.v1[c];
  const double* dv = Difference(system, states.v0, states.v1);
  direction_v_.assign(dv, dv + n);
  return {states.x0, states.v0, direction_x_.data(), direction_v_.data()};
}

StepOutcome LinearlyImplicitEuler::Step(ObjectSystem* system, StepSolver* solver,
                                        const StepStates& states,
                                        const StepResult& result) {
  const double h = states.h;
  const int n = system->num_coordinates();
  // f + h K v0 is the expansion along (h v0, 0).
  direction_x_.resize(n);
  direction_v_.assign(n, 0.0);
  force_.resize(n);
  for (int c = 0; c < n; ++c) direction_x_[c] = h * states.v0[c];
  system->Force({states.x0, states.v0, direction_x_.data(), direction_v_.data()},
                force_.data());
  system->AssembleStepMatrix(states.x0, states.v0, h, &solver->values());
  free_.resize(system->pattern().num_rows());
  system->GatherFree(force_.data(), free_.data());
  for (double& value : free_) value *= h;
  // Steps resemble each other: the last change of velocity is a good first guess.
  const double* guess =
      last_change_.size() == free_.size() ? last_change_.data() : nullptr;
  if (!solver->Factorize(system->IsSymmetric()) ||
      !solver->Solve(free_.data(), free_.data(), /*transposed=*/false, guess)) {
    return {RolloutStatus::Code::kLinearSolverFailed,
            "the step matrix M - h D - h^2 K is singular or not finite"};
  }
  last_change_ = free_;
  const double* dv = free_.data();
  for (int i : system->free_vertices()) {
    for (int c = 3 * i; c < 3 * i + 3; ++c) {
      result.v1[c] = states.v0[c] + *dv++;
      result.x1[c] = states.x0[c] + h * result.v1[c];
    }
  }
  return {};
}

bool LinearlyImplicitEuler::AdjointStep(ObjectSystem* system, StepSolver* solver,
                                        const StepStates& states,
                                        const StepAdjoint& adjoint) {
  SetMu(*system, states.h, adjoint);
  if (!SolveAdjointByKept(*system, solver)) {
    system->AssembleStepMatrix(states.x0, states.v0, states.h, &solver->values());
    if (!PrepareSolver(*system, solver) || !SolveAdjoint(*system, solver)) return false;
  }
  for (int i : system->free_vertices()) {
    for (int c = 3 * i; c < 3 * i + 3; ++c) {
      adjoint.gv[c] = system->parameters().mass[i] * lambda_[c];
    }
  }
  ForceState point = ExpansionPoint(*system, states);
  point.meanwhile = states.meanwhile;
  system->AddStepAdjoint(point, lambda_.data(), states.h, VelocityPart::kMinusPlain,
                         direction_v_.data(), adjoint.gx, adjoint.gv, adjoint.gp);
  return true;
}

void LinearlyImplicitEuler::TangentStage(int /*stage*/, ObjectSystem* system,
                                         StepSolver* solver, const StepStates& states,
                                         StageLinearization* out) {
  const ForceState point = ExpansionPoint(*system, states);
  out->c = states.h;
  system->AssembleStepMatrix(states.x0, states.v0, states.h, &solver->values());
  ClearLinearization(*system, out);
  system->AddJacobian(point, states.h, 0.0, VelocityPart::kWhole, out->rx.data());
  system->AddMass(out->rv.data());
  system->AddJacobian(point, 0.0, states.h, VelocityPart::kMinusPlain, out->rv.data());
  ListParameterEntries(*system, point, states.h, direction_v_.data(), out);
}

}  // namespace dpe
