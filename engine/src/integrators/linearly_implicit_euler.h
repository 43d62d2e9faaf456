// Linearly implicit Euler (Baraff & Witkin 1998, equation 6): one Newton step of
// implicit Euler from (x0, v0),
//   (M - h D - h^2 K)(v1 - v0) = h (f(x0, v0) + h K v0),  x1 = x0 + h v1,
// with K = df/dx, D = df/dv at (x0, v0).
//
// As a residual: r = M dv - h phi with dv = v1 - v0 and the expansion phi of f at
// (x0, v0) along (h v1, dv). Its derivative holds second derivatives of the force:
//   A = M - h D - h^2 K,  Rx = h dphi/dx,  Rv = M + h (dphi/dv - D);
// Rv follows from dr/dv0 at fixed dv, r's dependence on v1 = v0 + dv, and dv1 = dv0 +
// d(dv).
//
// Stability: where springs are compressed K has positive eigenvalues, and the cloth
// buckles. The velocity of a mode w of mass m that grows at the rate s, with m s^2 =
// w^T K w, is multiplied by about 1 / (1 - (h s)^2) in a step. Near h s = 1, where A is
// singular, that is without bound; beyond, A is indefinite. Implicit Euler gets along
// with such steps, as its f follows the mode to where it has buckled; here h must stay
// below 1 / s. With springs of a given stiffness s grows like m^(-1/2): the finer a
// cloth of given weight is cut, the shorter the steps must be.
#ifndef DPE_ENGINE_INTEGRATORS_LINEARLY_IMPLICIT_EULER_H_
#define DPE_ENGINE_INTEGRATORS_LINEARLY_IMPLICIT_EULER_H_

#include <string>
#include <vector>

#include "integrators/integrator.h"

namespace dpe {

class LinearlyImplicitEuler final : public Integrator {
 public:
  using Integrator::Integrator;

  bool LeavesAdjointFactor() const override { return true; }
  std::string DivergenceReason() const override {
    return "where springs are compressed its step matrix M - h D - h^2 K may be "
           "indefinite, and steps grow without bound; use shorter steps (delta, "
           "forwardSubSteps) or implicit_euler";
  }

  StepOutcome Step(ObjectSystem* system, StepSolver* solver, const StepStates& states,
                   const StepResult& result) override;
  void ForgetSteps() override { last_change_.clear(); }
  bool AdjointStep(ObjectSystem* system, StepSolver* solver, const StepStates& states,
                   const StepAdjoint& adjoint) override;
  void TangentStage(int stage, ObjectSystem* system, StepSolver* solver,
                    const StepStates& states, StageLinearization* out) override;
  ForceState ExpansionPoint(const ObjectSystem& system,
                            const StepStates& states) override;

 private:
  std::vector<double> direction_x_, direction_v_, force_, last_change_;
};

}  // namespace dpe

#endif  // DPE_ENGINE_INTEGRATORS_LINEARLY_IMPLICIT_EULER_H_
