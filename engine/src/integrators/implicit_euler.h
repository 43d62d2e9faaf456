// Implicit Euler: M (v1 - v0) = h f(x1, v1), x1 = x0 + h v1, solved for v1 by Newton's
// method with a backtracking line search on the residual's norm.
//
// Newton's matrix is A = M - h D - h^2 K at (x1, v1), the exact derivative of the
// residual, and iteration goes on to rounding level, so that the derivative of the
// converged step is the implicit function theorem's: Rx = h K, Rv = M at (x1, v1).
#ifndef DPE_ENGINE_INTEGRATORS_IMPLICIT_EULER_H_
#define DPE_ENGINE_INTEGRATORS_IMPLICIT_EULER_H_

#include <vector>

#include "integrators/integrator.h"

namespace dpe {

class ImplicitEuler final : public Integrator {
 public:
  using Integrator::Integrator;

  StepOutcome Step(ObjectSystem* system, const StepStates& states, double* x1,
                   double* v1) override;
  bool AdjointStep(ObjectSystem* system, const StepStates& states,
                   const StepAdjoint& adjoint) override;
  void TangentStep(ObjectSystem* system, const StepStates& states,
                   StepLinearization* out) override;
  ForceState ExpansionPoint(const ObjectSystem& system,
                            const StepStates& states) override;

 private:
  // residual_ := M (v1 - v0) - h f(x1, v1), x1 := x0 + h v1. Returns its norm and, in
  // `scale`, the norm of its largest term.
  double Residual(ObjectSystem* system, const StepStates& states, double* x1,
                  const double* v1, double* scale);
  // v1 += t step along the Newton step in `free_`, halving t until the norm falls.
  bool LineSearch(ObjectSystem* system, const StepStates& states, double* x1,
                  double* v1, double* norm, double* scale);

  std::vector<double> residual_, force_, free_, start_;
};

}  // namespace dpe

#endif  // DPE_ENGINE_INTEGRATORS_IMPLICIT_EULER_H_
