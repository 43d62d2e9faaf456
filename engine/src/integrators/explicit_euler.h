// Explicit and symplectic Euler: M v1 = M v0 + h f(x0, v0), and
//   explicit:   x1 = x0 + h v0,
//   symplectic: x1 = x0 + h v1.
// They differ only in the velocity that moves the positions. Tangent: A = M, Rx = h K,
// Rv = M + h D at (x0, v0).
#ifndef DPE_ENGINE_INTEGRATORS_EXPLICIT_EULER_H_
#define DPE_ENGINE_INTEGRATORS_EXPLICIT_EULER_H_

#include <vector>

#include "integrators/integrator.h"

namespace dpe {

class ExplicitEuler final : public Integrator {
 public:
  ExplicitEuler(const SimulatorOptions& options, bool symplectic)
      : Integrator(options), symplectic_(symplectic) {}

  bool UsesSolver() const override { return false; }

  StepOutcome Step(ObjectSystem* system, StepSolver* solver, const StepStates& states,
                   const StepResult& result) override;
  bool AdjointStep(ObjectSystem* system, StepSolver* solver, const StepStates& states,
                   const StepAdjoint& adjoint) override;
  void TangentStage(int stage, ObjectSystem* system, StepSolver* solver,
                    const StepStates& states, StageLinearization* out) override;
  ForceState ExpansionPoint(const ObjectSystem& system,
                            const StepStates& states) override;

 private:
  bool symplectic_;
  std::vector<double> force_;
};

}  // namespace dpe

#endif  // DPE_ENGINE_INTEGRATORS_EXPLICIT_EULER_H_
