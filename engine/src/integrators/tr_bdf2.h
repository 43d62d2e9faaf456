// TR-BDF2 (Bank et al. 1985; Hosea & Shampine 1996): a trapezoidal stage to t + gamma
// h, then the second-order backward difference formula over (0, gamma h, h). With gamma
// = 2 - sqrt(2) both stages have the same coefficient c = (gamma / 2) h and with it the
// same form of matrix. For y = (x, v), y' = F(y):
//   y_s = y_0 + c (F(y_0) + F(y_s)),
//   y_1 = w y_s - (w - 1) y_0 + c F(y_1),   w = (1 + sqrt(2)) / 2.
//
// Chosen over BDF2 because it is a one-step method: it starts by itself, any step may
// follow any other (a moving pin, a change of step), and its adjoint needs no states
// from before the step. Like BDF2 it is of second order and L-stable, so stiff springs
// do not ring; the price is a second solve per step.
//
// As stages (integrator.h): the first has Rx = c (K_0 + K_s), Rv = M + c D_0 + c^2 K_s,
// p = c; the second Rx = c K_1, Rv = M, input weights w and 1 - w.
#ifndef DPE_ENGINE_INTEGRATORS_TR_BDF2_H_
#define DPE_ENGINE_INTEGRATORS_TR_BDF2_H_

#include <vector>

#include "integrators/implicit_stage.h"
#include "integrators/integrator.h"

namespace dpe {

class TrBdf2 final : public Integrator {
 public:
  explicit TrBdf2(const SimulatorOptions& options)
      : Integrator(options), stage_(options) {}

  int num_stages() const override { return 2; }
  StepOutcome Step(ObjectSystem* system, StepSolver* solver, const StepStates& states,
                   const StepResult& result) override;
  bool AdjointStep(ObjectSystem* system, StepSolver* solver, const StepStates& states,
                   const StepAdjoint& adjoint) override;
  void TangentStage(int stage, ObjectSystem* system, StepSolver* solver,
                    const StepStates& states, StageLinearization* out) override;
  // The stage between is not known from x0, v0, x1, v1: the force at their middle,
  // which agrees with the step to second order.
  ForceState ExpansionPoint(const ObjectSystem& system,
                            const StepStates& states) override;

 private:
  // v_1 - w v_s + (w - 1) v_0, the velocity change that the second stage's force makes.
  const double* SecondChange(const ObjectSystem& system, const StepStates& states);

  ImplicitStage stage_;
  std::vector<double> x_in_, momentum_, force_, change_;
  std::vector<double> gx_stage_, gv_stage_;
};

}  // namespace dpe

#endif  // DPE_ENGINE_INTEGRATORS_TR_BDF2_H_
