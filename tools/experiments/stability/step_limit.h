// The longest step at which the explicit methods are stable, predicted from the forces'
// linearisation M x'' = -K x - C x', with K = -df/dx and C = -df/dv (springs, damping,
// drag and colliders in them).
//
// Its solutions are x = y e^(st), (s^2 M + s C + K) y = 0.
//
// Explicit Euler maps y e^(st) to (1 + h s) times itself. It is stable if |1 + h s| <
// 1,
//   h < -2 Re s / |s|^2,
// so for an oscillation without damping (Re s = 0) at no h, and for w^2 = y^T K y, c =
// y^T C y with y^T M y = 1: h < c / w^2 if it oscillates (c < 2 w). With Rayleigh's
// c = alpha + beta w^2 that is h < beta + alpha / w^2.
//
// Symplectic Euler's factor z of a mode fulfils
//   (z - 1)^2 M + h (z - 1) C + z h^2 K = 0;
// with y^* from the left a polynomial with the product of roots 1 - h c, which are in
// the unit disc if 0 < h c < 2 and 2 h c + h^2 w^2 < 4:
//   h < 4 / (c + sqrt(c^2 + 4 w^2)),
// which is 2 / w without damping and 2 / c for overdamped modes. For C and K that are
// symmetric the first root leaves at z = -1, where 4 M - 2 h C - h^2 K is singular,
// also if C and K do not share their modes.
//
// Modes that grow by themselves (a compressed cloth buckles: s > 0) are physics and say
// nothing about h.
#ifndef DPE_TOOLS_EXPERIMENTS_STABILITY_STEP_LIMIT_H_
#define DPE_TOOLS_EXPERIMENTS_STABILITY_STEP_LIMIT_H_

#include <Eigen/Core>
#include <string>

#include "dpe/engine/scene.h"

namespace dpe::experiments {

struct StepLimit {
  double omega_max = 0.0;  // rad/s, of M and the symmetric part of K, undamped
  double limit = 0.0;      // s
  // The largest factor by which the step at hand multiplies a mode that does not grow
  // by itself.
  double factor = 0.0;
};

// @param scene  its integration method is explicit or symplectic Euler
// @param x, v   3N, where forces are linearised
StepLimit PredictStepLimit(const Scene& scene, const Eigen::VectorXd& x,
                           const Eigen::VectorXd& v);

// Over a motion, since what is stretched, hit or blown has other frequencies than what
// rests: the largest omega_max, the least limit, and as factor the geometric mean of
// the factors above 1 over the steps, at the initial state and at some frames.
//
// A contact of stiffness K adds K / m to w^2, but may be shorter than a step of either
// motion. So states of contact are those that the method at hand steps into itself, all
// of them that differ in which vertices touch. What grows in contact is the motion of
// the vertices that touch, and only while they do: the factor takes in those of the
// steps in contact of the one vertex for which their product is largest.
//
// @param positions  3N x frames, of the reference; velocities are their differences
// @param own        3N x frames, of the method at hand, as far as it makes sense; the
//                   frames are steps
StepLimit PredictStepLimitAlong(const Scene& scene, const Eigen::MatrixXd& positions,
                                const Eigen::MatrixXd& own);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_STABILITY_STEP_LIMIT_H_
