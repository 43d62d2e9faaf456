// How strongly a motion depends on where it starts: whether a small disturbance of the
// state dies away or grows, which is what makes long motions hard to fit and to
// foretell.
//
// With z = (x_0, h v_0) the state at frame 0 (h, the length of a frame, makes both
// lengths) and Phi_f(z) the positions at frame f, the growth up to the last frame F is
//
//   g = max |d Phi_F / dz . u|  over |u| = 1:
//
// the largest singular value of the tangent of the whole rollout, found by power
// iteration u <- T^T T u with T = d Phi_F / dz (one tangent and one adjoint pass each;
// Golub & Van Loan, Matrix Computations, section 8.2). It is approached from below. The
// growth by frame is that of the direction u that grows the most in the end. ln(g) / (F
// h) is the finite-time Lyapunov exponent (Voss, Timmer & Kurths 2004, section 2).
#ifndef DPE_ESTIMATION_MOTION_SENSITIVITY_H_
#define DPE_ESTIMATION_MOTION_SENSITIVITY_H_

#include <Eigen/Core>
#include <string>

#include "dpe/engine/scene.h"
#include "dpe/engine/simulator.h"
#include "dpe/estimation/export.h"

namespace dpe {

struct MotionSensitivity {
  bool ok = false;
  std::string message;  // why not
  int num_frames = 0;
  double growth = 0.0;  // g
  // One per frame: |d Phi_f / dz . u|, u being that of g.
  Eigen::VectorXd growth_by_frame;
  // s, in which a disturbance doubles; infinite if it does not.
  double doubling_time = 0.0;
  std::string text;  // one sentence of what that means
};

// Of the objects of which something is estimated, with the scene's values; of all, if
// there are none. Never throws.
//
// @param scene       what moves
// @param num_frames  of the motion, at least 2
// @param options     threads, memory and interruption
DPE_ESTIMATION_API MotionSensitivity ComputeMotionSensitivity(
    const Scene& scene, int num_frames, const SimulatorOptions& options = {});

}  // namespace dpe

#endif  // DPE_ESTIMATION_MOTION_SENSITIVITY_H_
