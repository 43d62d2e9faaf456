// One cell of the stability experiment: an integrator and a linear solver at one value
// of one axis.
#ifndef DPE_TOOLS_EXPERIMENTS_STABILITY_STABILITY_CELL_H_
#define DPE_TOOLS_EXPERIMENTS_STABILITY_STABILITY_CELL_H_

#include <string>

#include "dpe/engine/scene.h"
#include "experiments/record.h"
#include "experiments/stability/gradient_check.h"

namespace dpe::experiments {

struct StabilityCell {
  std::string axis;
  double value = 0.0;
  IntegrationMethod method = IntegrationMethod::kImplicitEuler;
  std::string solver = "cholesky";  // explicit methods have none to choose
};

// The error, as a fraction of the size of the motion (root mean squares over frames and
// free vertices, motion: displacement from the start), up to which a cell is accurate.
constexpr double kAccurate = 0.05;
// A motion larger than the reference's by this factor has blown up.
constexpr double kBlownUp = 10.0;

// Simulates the cell and judges it. Columns of the result:
//   result      "accurate", "inaccurate" (stable but off by more than kAccurate),
//               "blown_up" (finite, but larger than the reference by kBlownUp),
//               "undecided" (stable; the reference is not good enough to tell),
//               "failed" (a rollout's status) or "refused" (not a valid scene)
//   why         the reason of "failed", "refused" and "undecided"
//   failed_frame, failed_step
//   error, reference_error   fractions of the motion
//   motion      m
//   penetration m, the deepest that any vertex is in the collider at any frame, up to
//               where the motion blows up; scenes with a collider
//   reference   method and steps of it to one of the cell
//   limit, omega_max, growth, prediction, agreement
//               explicit methods: see step_limit.h
//   gradient    "right", "not decidable", "wrong", "refused", "" if not stable
//   gradient_why, gradient_error, gradient_noise, gradient_identity
Record RunStabilityCell(const StabilityCell& cell,
                        const DerivativeFunction& derivatives = EngineDerivatives);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_STABILITY_STABILITY_CELL_H_
