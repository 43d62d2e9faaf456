// The states that a rollout passes through, one column per frame.
#ifndef DPE_ENGINE_TRAJECTORY_H_
#define DPE_ENGINE_TRAJECTORY_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "dpe/engine/export.h"

namespace dpe {

// Whether a rollout reached its last frame, or a derivative pass over it came through,
// and if not, where and why it stopped.
struct RolloutStatus {
  enum class Pass { kRollout, kDerivative };
  enum class Code {
    kOk,
    kNotFinite,           // a state became NaN or infinite, or left 1e12 m; or a
                          // derivative did, which grows with each unstable step
    kNewtonFailed,        // Newton's method did not converge
    kLinearSolverFailed,  // the step's linear system could not be solved
    kInterrupted,         // the caller's `interrupted` said so
  };
  Pass pass = Pass::kRollout;
  Code code = Code::kOk;
  int object = -1;
  int frame = -1;  // the frame that could not be reached, or come from
  int step = -1;   // step within that frame; -1: found at the frame's end
  std::string reason;

  bool ok() const { return code == Code::kOk; }
  // One sentence: what failed, in which object, frame and step.
  DPE_ENGINE_API std::string Message() const;
};

// Frame 0 is the initial state; F frames are F-1 frame lengths.
struct Trajectory {
  // One matrix per object of the scene, 3N x F, xyz interleaved, m and m/s; 0 x 0 for
  // objects that were not simulated. After a failure, frames from status.frame on are
  // NaN.
  std::vector<Eigen::MatrixXd> positions;
  std::vector<Eigen::MatrixXd> velocities;
  RolloutStatus status;

  int num_frames() const {
    for (const Eigen::MatrixXd& p : positions) {
      if (p.size() > 0) return static_cast<int>(p.cols());
    }
    return 0;
  }
};

}  // namespace dpe

#endif  // DPE_ENGINE_TRAJECTORY_H_
