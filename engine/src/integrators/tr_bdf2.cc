#include "integrators/tr_bdf2.h"

#include <algorithm>
#include <cmath>

namespace dpe {
namespace {

const double kHalfGamma = 1.0 - std::sqrt(0.5);
const double kWeight = 0.5 * (1.0 + std::sqrt(2.0));

}  // namespace

ForceState TrBdf2::ExpansionPoint(const ObjectSystem& system,
                                  const StepStates& states) {
  const int n = system.num_coordinates();
  x_in_.resize(n);
  momentum_.resize(n);
  for (int k = 0; k < n; ++k) {
    x_in_[k] = 0.5 * (states.x0[k] + states.x1[k]);
    momentum_[k] = 0.5 * (states.v0[k] + states.v1[k]);
  }
  return {x_in_.data(), momentum_.data(), nullptr, nullptr};
}

StepOutcome TrBdf2::Step(ObjectSystem* system, StepSolver* solver,
                         const StepStates& states, const StepResult& result) {
  const int n = system->num_coordinates();
  const double c = kHalfGamma * states.h;
  const Eigen::VectorXd& mass = system->parameters().mass;
  solver->Reset();  // both stages have nearly the same matrix and share a factorisation
  force_.resize(n);
  x_in_.resize(n);
  momentum_.assign(n, 0.0);
  // Fixed vertices move evenly over the step.
  for (int k = 0; k < n; ++k) {
    result.xs[k] = states.x0[k] + 2.0 * c * states.v0[k];
    result.vs[k] = states.v0[k];
  }
  system->Force({states.x0, states.v0, nullptr, nullptr}, force_.data());
  for (int i : system->free_vertices()) {
    for (int k = 3 * i; k < 3 * i + 3; ++k) {
      x_in_[k] = states.x0[k] + c * states.v0[k];
      momentum_[k] = mass[i] * states.v0[k] + c * force_[k];
    }
  }
  StepOutcome outcome = stage_.Solve(system, solver, c, x_in_.data(), momentum_.data(),
                                     result.xs, result.vs);
  if (!outcome.ok()) return outcome;
  for (int i : system->free_vertices()) {
    for (int k = 3 * i; k < 3 * i + 3; ++k) {
      x_in_[k] = kWeight * result.xs[k] - (kWeight - 1.0) * states.x0[k];
      momentum_[k] =
          mass[i] * (kWeight * result.vs[k] - (kWeight - 1.0) * states.v0[k]);
      result.v1[k] = result.vs[k];
    }
  }
  return stage_.Solve(system, solver, c, x_in_.data(), momentum_.data(), result.x1,
                      result.v1);
}

const double* TrBdf2::SecondChange(const ObjectSystem& system,
                                   const StepStates& states) {
  change_.assign(system.num_coordinates(), 0.0);
  for (int i : system.free_vertices()) {
    for (int k = 3 * i; k < 3 * i + 3; ++k) {
      change_[k] =
          states.v1[k] - kWeight * states.vs[k] + (kWeight - 1.0) * states.v0[k];
    }
  }
  return change_.data();
}

bool TrBdf2::AdjointStep(ObjectSystem* system, StepSolver* solver,
                         const StepStates& states, const StepAdjoint& adjoint) {
  const int n = system->num_coordinates();
  const double c = kHalfGamma * states.h;
  const Eigen::VectorXd& mass = system->parameters().mass;
  // Second stage: (gx, gv) become the adjoint of its input.
  const ForceState end{states.x1, states.v1, nullptr, nullptr};
  SetMu(*system, c, adjoint);
  system->AssembleStepMatrix(states.x1, states.v1, c, &solver->values());
  if (!PrepareSolver(*system, solver) || !SolveAdjoint(*system, solver)) return false;
  system->AddStepAdjoint(end, lambda_.data(), c, VelocityPart::kWhole,
                         SecondChange(*system, states), adjoint.gx, /*gv=*/nullptr,
                         adjoint.gp);
  gx_stage_.resize(n);
  gv_stage_.resize(n);
  for (int i = 0; i < system->num_vertices(); ++i) {
    for (int k = 3 * i; k < 3 * i + 3; ++k) {
      const double gv = mass[i] * lambda_[k];
      gx_stage_[k] = kWeight * adjoint.gx[k];
      gv_stage_[k] = kWeight * gv;
      adjoint.gx[k] *= 1.0 - kWeight;
      adjoint.gv[k] = (1.0 - kWeight) * gv;
    }
  }
  // First stage.
  const ForceState start{states.x0, states.v0, nullptr, nullptr};
  const ForceState middle{states.xs, states.vs, nullptr, nullptr};
  SetMu(*system, c, {gx_stage_.data(), gv_stage_.data(), nullptr});
  system->AssembleStepMatrix(states.xs, states.vs, c, &solver->values());
  if (!PrepareSolver(*system, solver) || !SolveAdjoint(*system, solver)) return false;
  for (int i = 0; i < system->num_vertices(); ++i) {
    for (int k = 3 * i; k < 3 * i + 3; ++k) {
      adjoint.gx[k] += gx_stage_[k];
      adjoint.gv[k] += mass[i] * lambda_[k] + c * gx_stage_[k];
    }
  }
  std::fill(change_.begin(), change_.end(), 0.0);
  system->AddStepAdjoint(start, lambda_.data(), c, VelocityPart::kWhole, change_.data(),
                         adjoint.gx, adjoint.gv, adjoint.gp);
  // K_s acts on x0 and, through the stage's c v0, on v0.
  std::fill(gx_stage_.begin(), gx_stage_.end(), 0.0);
  system->AddStepAdjoint(middle, lambda_.data(), c, VelocityPart::kWhole,
                         Difference(*system, states.v0, states.vs), gx_stage_.data(),
                         /*gv=*/nullptr, adjoint.gp);
  for (int k = 0; k < n; ++k) {
    adjoint.gx[k] += gx_stage_[k];
    adjoint.gv[k] += c * gx_stage_[k];
  }
  return true;
}

void TrBdf2::TangentStage(int stage, ObjectSystem* system, StepSolver* solver,
                          const StepStates& states, StageLinearization* out) {
  const double c = kHalfGamma * states.h;
  const ForceState start{states.x0, states.v0, nullptr, nullptr};
  const ForceState middle{states.xs, states.vs, nullptr, nullptr};
  const ForceState end{states.x1, states.v1, nullptr, nullptr};
  const ForceState& point = stage == 0 ? middle : end;
  out->c = c;
  system->AssembleStepMatrix(point.x, point.v, c, &solver->values());
  ClearLinearization(*system, out);
  system->AddJacobian(point, c, 0.0, VelocityPart::kWhole, out->rx.data());
  system->AddMass(out->rv.data());
  if (stage == 1) {
    out->p = 0.0;
    out->weight = kWeight;
    out->start_weight = 1.0 - kWeight;
    ListParameterEntries(*system, end, c, SecondChange(*system, states), out);
    return;
  }
  out->p = c;
  out->weight = 1.0;
  out->start_weight = 0.0;
  system->AddJacobian(middle, c * c, 0.0, VelocityPart::kWhole, out->rv.data());
  system->AddJacobian(start, c, 0.0, VelocityPart::kWhole, out->rx.data());
  system->AddJacobian(start, 0.0, c, VelocityPart::kWhole, out->rv.data());
  ListParameterEntries(*system, middle, c, Difference(*system, states.v0, states.vs),
                       out);
  change_.assign(system->num_coordinates(), 0.0);
  ListParameterEntries(*system, start, c, change_.data(), out);
}

}  // namespace dpe
