// Explicit and symplectic Euler: M v1 = M v0 + h f(x0, v0), and
//   explicit:   x1 = x0 + h v0,
//   symplectic: x1 = x0 + h v1.
// They differ only in the velocity that moves the positions. Tangent: A = M, Rx = h K,
// Rv = M + h D at (x0, v0).
//
// Stability: a mode x'' = -w^2 x - c x' is multiplied in each step by the roots z of
//   explicit:   z^2 - (2 - h c) z + 1 - h c + h^2 w^2,
//   symplectic: z^2 - (2 - h c - h^2 w^2) z + 1 - h c,
// which lie in the unit disc (Jury's conditions) if
//   explicit:   h < c / w^2, and for c > 2 w besides h < 4 / (c + sqrt(c^2 - 4 w^2)),
//   symplectic: h < 4 / (c + sqrt(c^2 + 4 w^2)).
// Springs with Rayleigh damping have c = alpha + beta w^2.
#ifndef DPE_ENGINE_INTEGRATORS_EXPLICIT_EULER_H_
#define DPE_ENGINE_INTEGRATORS_EXPLICIT_EULER_H_

#include <string>
#include <vector>

#include "integrators/integrator.h"

namespace dpe {

class ExplicitEuler final : public Integrator {
 public:
  ExplicitEuler(const SimulatorOptions& options, bool symplectic)
      : Integrator(options), symplectic_(symplectic) {}

  bool UsesSolver() const override { return false; }
  std::string DivergenceReason() const override {
    return symplectic_
               ? "symplectic_euler is unstable for steps h longer than 4 / (c + "
                 "sqrt(c^2 + 4 w^2)), "
                 "2 / w without damping, with the highest frequency w and its damping "
                 "rate c; use shorter steps (delta, forwardSubSteps) or implicit_euler"
               : "explicit_euler is unstable for steps h longer than c / w^2, with the "
                 "highest frequency w and its damping rate c, so without damping for "
                 "any; use much shorter steps (delta, forwardSubSteps) or another "
                 "integrationMethod";
  }

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
