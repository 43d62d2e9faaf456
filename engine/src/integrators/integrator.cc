#include "integrators/integrator.h"

#include "integrators/explicit_euler.h"
#include "integrators/implicit_euler.h"
#include "integrators/linearly_implicit_euler.h"

namespace dpe {

const double* Integrator::VelocityChange(const ObjectSystem& system,
                                         const StepStates& states) {
  delta_.assign(system.num_coordinates(), 0.0);
  for (int i : system.free_vertices()) {
    for (int c = 3 * i; c < 3 * i + 3; ++c) delta_[c] = states.v1[c] - states.v0[c];
  }
  return delta_.data();
}

void Integrator::AssembleStepMatrix(ObjectSystem* system, const ForceState& point,
                                    double h) {
  std::vector<double>& values = system->solver().values();
  std::fill(values.begin(), values.end(), 0.0);
  system->AddMass(values.data());
  const ForceState plain{point.x, point.v, nullptr, nullptr};
  system->AddJacobian(plain, -h * h, -h, VelocityPart::kWhole, values.data());
}

bool Integrator::SolveAdjoint(ObjectSystem* system, double h,
                              const StepAdjoint& adjoint) {
  lambda_.assign(system->num_coordinates(), 0.0);
  for (int i : system->free_vertices()) {
    for (int c = 3 * i; c < 3 * i + 3; ++c) {
      lambda_[c] = adjoint.gv[c] + h * adjoint.gx[c];
    }
  }
  free_.resize(system->pattern().num_rows());
  system->GatherFree(lambda_.data(), free_.data());
  if (!system->solver().Factorize(system->IsSymmetric())) return false;
  if (!system->solver().Solve(free_.data(), free_.data(), /*transposed=*/true)) {
    return false;
  }
  system->ScatterFree(free_.data(), lambda_.data());
  return true;
}

void Integrator::SolveAdjointMass(const ObjectSystem& system, double h,
                                  const StepAdjoint& adjoint) {
  lambda_.assign(system.num_coordinates(), 0.0);
  for (int i : system.free_vertices()) {
    for (int c = 3 * i; c < 3 * i + 3; ++c) {
      lambda_[c] = (adjoint.gv[c] + h * adjoint.gx[c]) / system.parameters().mass[i];
    }
  }
}

void Integrator::AddParameterAdjoint(const ObjectSystem& system,
                                     const StepStates& states, const ForceState& point,
                                     double* gp) {
  if (system.local_columns().used().empty()) return;
  ParameterSink sink(system.local_columns(), 1.0, lambda_.data(), gp);
  system.VisitStepParameters(point, states.h, VelocityChange(system, states), &sink);
}

void Integrator::ListParameterEntries(const ObjectSystem& system,
                                      const StepStates& states, const ForceState& point,
                                      StepLinearization* out) {
  out->entries.clear();
  ParameterSink sink(system.local_columns(), 1.0, system.node_of_vertex(),
                     &out->entries);
  system.VisitStepParameters(point, states.h, VelocityChange(system, states), &sink);
}

void Integrator::ClearLinearization(const ObjectSystem& system,
                                    StepLinearization* out) {
  out->rx.assign(system.pattern().num_nonzeros(), 0.0);
  out->rv.assign(system.pattern().num_nonzeros(), 0.0);
}

std::unique_ptr<Integrator> MakeIntegrator(IntegrationMethod method,
                                           const SimulatorOptions& options) {
  switch (method) {
    case IntegrationMethod::kExplicitEuler:
      return std::make_unique<ExplicitEuler>(options, /*symplectic=*/false);
    case IntegrationMethod::kSymplecticEuler:
      return std::make_unique<ExplicitEuler>(options, /*symplectic=*/true);
    case IntegrationMethod::kLinearlyImplicitEuler:
      return std::make_unique<LinearlyImplicitEuler>(options);
    case IntegrationMethod::kImplicitEuler:
      return std::make_unique<ImplicitEuler>(options);
  }
  return nullptr;
}

}  // namespace dpe
