// How a derivative pass over an object's steps ended.
#ifndef DPE_ENGINE_DERIVATIVES_PASS_OUTCOME_H_
#define DPE_ENGINE_DERIVATIVES_PASS_OUTCOME_H_

#include <string>
#include <utility>

#include "integrators/integrator.h"

namespace dpe {

struct PassOutcome {
  StepOutcome outcome;
  int step = -1;  // of the rollout, 0-based: where the pass stopped

  bool ok() const { return outcome.ok(); }
};

// What to say of a step whose linear system could not be solved: a solver fails too
// where it is given what is not finite.
inline StepOutcome UnsolvedStep(bool is_finite, bool transposed) {
  if (!is_finite) return {RolloutStatus::Code::kNotFinite, ""};
  return {RolloutStatus::Code::kLinearSolverFailed,
          transposed ? "the adjoint of the step matrix is singular or not finite"
                     : "the step matrix is singular or not finite"};
}

}  // namespace dpe

#endif  // DPE_ENGINE_DERIVATIVES_PASS_OUTCOME_H_
