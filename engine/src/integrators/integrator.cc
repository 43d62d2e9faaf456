#include "integrators/integrator.h"

#include <algorithm>

#include "integrators/explicit_euler.h"
#include "integrators/implicit_euler.h"
#include "integrators/linearly_implicit_euler.h"
#include "integrators/tr_bdf2.h"

namespace dpe {

const double* Integrator::Difference(const ObjectSystem& system, const double* a,
                                     const double* b) {
  difference_.assign(system.num_coordinates(), 0.0);
  for (int i : system.free_vertices()) {
    for (int c = 3 * i; c < 3 * i + 3; ++c) difference_[c] = b[c] - a[c];
  }
  return difference_.data();
}

void Integrator::SetMu(const ObjectSystem& system, double c,
                       const StepAdjoint& adjoint) {
  lambda_.assign(system.num_coordinates(), 0.0);
  for (int i : system.free_vertices()) {
    for (int k = 3 * i; k < 3 * i + 3; ++k) {
      lambda_[k] = adjoint.gv[k] + c * adjoint.gx[k];
    }
  }
}

bool Integrator::SolveAdjoint(const ObjectSystem& system, StepSolver* solver) {
  free_.resize(system.pattern().num_rows());
  system.GatherFree(lambda_.data(), free_.data());
  const double* guess =
      last_adjoint_.size() == free_.size() ? last_adjoint_.data() : nullptr;
  if (!solver->Solve(free_.data(), free_.data(), /*transposed=*/true, guess)) {
    return false;
  }
  last_adjoint_ = free_;
  system.ScatterFree(free_.data(), lambda_.data());
  return true;
}

bool Integrator::SolveAdjointByKept(const ObjectSystem& system, StepSolver* solver) {
  free_.resize(system.pattern().num_rows());
  last_adjoint_.resize(free_.size());
  system.GatherFree(lambda_.data(), free_.data());
  if (!solver->SolveByKept(free_.data(), last_adjoint_.data(), /*transposed=*/true)) {
    last_adjoint_.clear();
    return false;
  }
  system.ScatterFree(last_adjoint_.data(), lambda_.data());
  return true;
}

void Integrator::ListParameterEntries(const ObjectSystem& system,
                                      const ForceState& point, double c,
                                      const double* dv, StageLinearization* out) {
  ParameterSink sink(system.local_columns(), 1.0, system.node_of_vertex(),
                     &out->entries);
  system.VisitStepParameters(point, c, dv, &sink);
}

void Integrator::ClearLinearization(const ObjectSystem& system,
                                    StageLinearization* out) {
  out->rx.assign(system.pattern().num_nonzeros(), 0.0);
  out->rv.assign(system.pattern().num_nonzeros(), 0.0);
  out->entries.clear();
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
    case IntegrationMethod::kTrBdf2:
      return std::make_unique<TrBdf2>(options);
  }
  return nullptr;
}

}  // namespace dpe
