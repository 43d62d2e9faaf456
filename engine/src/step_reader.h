// The states around any step of a rollout, for derivative passes: read from the
// trajectory and from what the rollout kept, and where it kept nothing, made again by
// taking the steps of that frame from its checkpoint.
#ifndef DPE_ENGINE_STEP_READER_H_
#define DPE_ENGINE_STEP_READER_H_

#include <Eigen/Core>

#include "frame_runner.h"
#include "rollout_tape.h"

namespace dpe {

// One object's rollout. What it points to must outlive those who use it.
struct ObjectRecord {
  const Scene* scene = nullptr;
  const SimulatorOptions* options = nullptr;
  ObjectSystem* system = nullptr;
  const ObjectTape* tape = nullptr;
  const Eigen::MatrixXd* positions = nullptr;   // 3N x F
  const Eigen::MatrixXd* velocities = nullptr;  // 3N x F
};

class StepReader {
 public:
  explicit StepReader(const ObjectRecord& record);

  // The states around step `s` (0-based, of the whole rollout). They stay valid until
  // the next call, which is cheapest for a step of the same frame. May use the system's
  // solver. Not ok if the steps of a frame could not be taken again, or `interrupted`
  // is true.
  StepOutcome Read(int s, StepStates* states);

 private:
  // Makes the inner states of `frame` again, unless the buffer has them.
  StepOutcome Rerun(int frame);

  ObjectRecord record_;
  FrameRunner runner_;
  InnerStates buffer_;  // of frame buffered_
  int buffered_ = -1;
  Eigen::VectorXd x_end_, v_end_;  // of a frame run again
  Eigen::VectorXd v0_;
};

}  // namespace dpe

#endif  // DPE_ENGINE_STEP_READER_H_
