// Implicit Euler: M (v1 - v0) = h f(x1, v1), x1 = x0 + h v1: one implicit stage
// (implicit_stage.h) with c = h. Its derivative: A = M - h D - h^2 K, Rx = h K, Rv = M,
// all at (x1, v1).
#ifndef DPE_ENGINE_INTEGRATORS_IMPLICIT_EULER_H_
#define DPE_ENGINE_INTEGRATORS_IMPLICIT_EULER_H_

#include <vector>

#include "integrators/implicit_stage.h"
#include "integrators/integrator.h"

namespace dpe {

class ImplicitEuler final : public Integrator {
 public:
  explicit ImplicitEuler(const SimulatorOptions& options)
      : Integrator(options), stage_(options) {}

  StepOutcome Step(ObjectSystem* system, StepSolver* solver, const StepStates& states,
                   const StepResult& result) override;
  bool AdjointStep(ObjectSystem* system, StepSolver* solver, const StepStates& states,
                   const StepAdjoint& adjoint) override;
  void TangentStage(int stage, ObjectSystem* system, StepSolver* solver,
                    const StepStates& states, StageLinearization* out) override;
  ForceState ExpansionPoint(const ObjectSystem& system,
                            const StepStates& states) override;

 private:
  ImplicitStage stage_;
  std::vector<double> momentum_;
};

}  // namespace dpe

#endif  // DPE_ENGINE_INTEGRATORS_IMPLICIT_EULER_H_
