// What a rollout leaves behind for its derivative passes: the states before and after
// every step of every simulated object.
#ifndef DPE_ENGINE_ROLLOUT_TAPE_H_
#define DPE_ENGINE_ROLLOUT_TAPE_H_

#include <Eigen/Core>
#include <vector>

#include "integrators/integrator.h"
#include "object_system.h"

namespace dpe {

// Column s is the state after s steps, 3N x (steps + 1). Velocities of fixed vertices
// in column s are those of the step that ends there.
struct ObjectTape {
  Eigen::MatrixXd positions;
  Eigen::MatrixXd velocities;
};

class RolloutTape {
 public:
  std::vector<ObjectTape> objects;  // empty matrices: not simulated
  int steps_per_frame = 1;
};

// The states around step `s` (0-based) of a tape. v0 is copied into `v0_buffer` because
// its fixed entries must hold the velocity over this step.
inline StepStates StatesOfStep(const ObjectSystem& system, const ObjectTape& tape,
                               int s, double h, Eigen::VectorXd* v0_buffer) {
  *v0_buffer = tape.velocities.col(s);
  system.SetPrescribedVelocities(h, tape.positions.col(s).data(),
                                 tape.positions.col(s + 1).data(), v0_buffer->data());
  return {h, tape.positions.col(s).data(), v0_buffer->data(),
          tape.positions.col(s + 1).data(), tape.velocities.col(s + 1).data()};
}

}  // namespace dpe

#endif  // DPE_ENGINE_ROLLOUT_TAPE_H_
