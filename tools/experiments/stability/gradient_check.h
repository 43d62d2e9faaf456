// Whether the derivatives of a cell's rollout are right, and whether that can be known.
//
// For L = sum w x, random weights w over all positions of all frames, and a direction d
// of the parameters:
//   identity     <dL/dp, d> by the adjoint = <w, dx> by the tangent, to rounding;
//   differences  dx against central differences of the rollout, through the engine's
//                checker, one step size s at a time.
// Extremes make differences inexact: too large an s truncates, too small a one drowns
// in the rounding of positions. The quotients of two neighbouring s differ by about the
// error of the worse, which is reported as the differences' own noise. A direction is
//   right          if tangent and quotient agree within 10 times that noise (or 1e-6);
//   wrong          if they do not, though the noise is below 1e-4; or if a derivative
//                  is not finite and nothing said so; or if adjoint and tangent differ
//                  by more than 1e-4;
//   not decidable  if all quotients are noisier than 1e-4, or adjoint and tangent
//                  differ by more than 1e-6; or if the motion passes a kink closer than
//                  the steps: the quotients from the two sides then differ by as much
//                  as the tangent from their mean, at ever smaller s, while where a
//                  derivative exists they differ in proportion to s. (A spring whose
//                  ends pass each other, a triangle that collapses, a contact that
//                  begins.) It never counts as right.
// A parameter whose influence is exactly zero is right if both say so.
#ifndef DPE_TOOLS_EXPERIMENTS_STABILITY_GRADIENT_CHECK_H_
#define DPE_TOOLS_EXPERIMENTS_STABILITY_GRADIENT_CHECK_H_

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "dpe/engine/scene.h"
#include "dpe/engine/sensitivity.h"

namespace dpe::experiments {

enum class GradientVerdict { kRight, kUndecidable, kWrong, kRefused };

std::string GradientVerdictName(GradientVerdict verdict);

struct GradientCheck {
  GradientVerdict verdict = GradientVerdict::kRight;  // the worst of all directions
  std::string why;        // of the first direction with that verdict
  double error = 0.0;     // the largest relative disagreement with differences
  double noise = 0.0;     // of the differences, in that direction
  double identity = 0.0;  // the largest relative disagreement of adjoint and tangent
  int right = 0, undecidable = 0, wrong = 0;  // directions
};

// What is checked: a seam at which tests put wrong derivatives.
struct Derivatives {
  Eigen::VectorXd gradient;               // of L
  std::vector<Eigen::MatrixXd> tangents;  // of the positions, one per direction
  std::string failure;                    // empty: none
};
using DerivativeFunction = std::function<Derivatives(
    Simulator*, const Rollout&, const Eigen::MatrixXd& weights,
    const std::vector<Eigen::VectorXd>& directions)>;

// Those of the engine.
Derivatives EngineDerivatives(Simulator* simulator, const Rollout& rollout,
                              const Eigen::MatrixXd& weights,
                              const std::vector<Eigen::VectorXd>& directions);

// Marks what is checked as estimated: one mass and one stiffness for all, damping,
// drag and wind where there are such, and initial velocities.
void EstimateForCheck(Scene* scene);

// @param scene  simulates without failure
GradientCheck CheckGradient(const Scene& scene, int num_frames,
                            const DerivativeFunction& derivatives = EngineDerivatives);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_STABILITY_GRADIENT_CHECK_H_
