// The motion that candidates are compared with: that of the continuous equations
// M x'' = f(x, x'), as nearly as it can be had.
//
// Implicit Euler, even with 64 steps per frame, is no reference: its error falls with
// the step only, e(h) = a h + O(h^2), and at delta / 64 it is 0.3 mm after 20 frames
// and several millimetres to centimetres after 100, a thousand times that of TR-BDF2
// with the same steps, and worse than TR-BDF2 with one step per frame. So the reference
// is TR-BDF2 with 64 and with 128 steps per frame, which has e(h) = a h^2 + O(h^3),
// extrapolated (Richardson):
//   x = x_128 + (x_128 - x_64) / 3.
// The error estimate of x_128, |x_128 - x_64| / 3, is reported as the reference's own
// uncertainty, an upper bound of it: differences below that mean nothing. Implicit
// Euler at delta / 64 is one of the candidates.
#ifndef DPE_TOOLS_EXPERIMENTS_TRADEOFF_REFERENCE_H_
#define DPE_TOOLS_EXPERIMENTS_TRADEOFF_REFERENCE_H_

#include <Eigen/Core>

#include "dpe/engine/scene.h"
#include "experiments/experiment.h"

namespace dpe::experiments::tradeoff {

struct Reference {
  Eigen::MatrixXd positions;    // 3N x frames, m
  Eigen::MatrixXd uncertainty;  // 3N x frames, m: x - x_128
};

// @param scene  with one object; its own time step makes no difference
// @throws SceneError if it cannot be simulated
Reference ComputeReference(const Scene& scene, int frames);

// The same, kept in the system's folder of temporary files for the next process that
// asks for it. The key holds the scene and a coarse rollout of it, bit by bit, so that
// a change of the simulator does not find the reference of the old one.
Reference CachedReference(const Scene& scene, int frames);

// The distance of a motion from the reference over frames 1 to `horizon`.
struct MotionError {
  double rms = 0.0;  // m, over free vertices and frames
  double max = 0.0;  // m
};
MotionError ErrorOver(const Eigen::MatrixXd& difference, const Scene& scene,
                      int horizon);

// Frames at which errors are reported, as far as they are simulated.
constexpr int kHorizons[] = {20, 50, 100};

// The kind of job that reports a reference's uncertainty.
Record RunReferenceJob(const Job& job);

}  // namespace dpe::experiments::tradeoff

#endif  // DPE_TOOLS_EXPERIMENTS_TRADEOFF_REFERENCE_H_
