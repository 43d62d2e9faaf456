// The states that a rollout passes through between the frames of its trajectory.
#ifndef DPE_ENGINE_INNER_STATES_H_
#define DPE_ENGINE_INNER_STATES_H_

#include <Eigen/Core>
#include <cstddef>

namespace dpe {

// For each frame that it has room for: the states after every step but the last, and
// those of the stages within the steps of methods with two stages. A frame of one step
// of one stage has none of either.
class InnerStates {
 public:
  // Bytes that one frame takes.
  //
  // @param n  coordinates, 3 per vertex
  static std::size_t BytesPerFrame(int n, int steps_per_frame, int num_stages) {
    const int states = steps_per_frame - 1 + (num_stages > 1 ? steps_per_frame : 0);
    return 2 * sizeof(double) * static_cast<std::size_t>(n) * states;
  }

  void Resize(int n, int steps_per_frame, int num_stages, int num_frames) {
    num_frames_ = num_frames;
    steps_per_frame_ = steps_per_frame;
    const int steps = (steps_per_frame - 1) * num_frames;
    const int stages = num_stages > 1 ? steps_per_frame * num_frames : 0;
    positions_.resize(n, steps);
    velocities_.resize(n, steps);
    stage_positions_.resize(n, stages);
    stage_velocities_.resize(n, stages);
  }

  int num_frames() const { return num_frames_; }
  std::size_t bytes() const {
    return 2 * sizeof(double) * (positions_.size() + stage_positions_.size());
  }

  // The state after `step` steps of a frame, 0 < step < steps_per_frame; 3N.
  const double* x(int frame, int step) const {
    return positions_.data() + Offset(frame, step);
  }
  const double* v(int frame, int step) const {
    return velocities_.data() + Offset(frame, step);
  }
  double* x(int frame, int step) { return positions_.data() + Offset(frame, step); }
  double* v(int frame, int step) { return velocities_.data() + Offset(frame, step); }

  // The stage within step `step` of a frame, 0 <= step < steps_per_frame, of methods
  // with two stages.
  const double* xs(int frame, int step) const {
    return stage_positions_.data() + StageOffset(frame, step);
  }
  const double* vs(int frame, int step) const {
    return stage_velocities_.data() + StageOffset(frame, step);
  }
  double* xs(int frame, int step) {
    return stage_positions_.data() + StageOffset(frame, step);
  }
  double* vs(int frame, int step) {
    return stage_velocities_.data() + StageOffset(frame, step);
  }

 private:
  std::ptrdiff_t Offset(int frame, int step) const {
    return positions_.rows() * (frame * (steps_per_frame_ - 1) + step - 1);
  }
  std::ptrdiff_t StageOffset(int frame, int step) const {
    return stage_positions_.rows() * (frame * steps_per_frame_ + step);
  }

  int num_frames_ = 0;
  int steps_per_frame_ = 1;
  Eigen::MatrixXd positions_, velocities_;              // 3N x inner states
  Eigen::MatrixXd stage_positions_, stage_velocities_;  // 3N x stages
};

}  // namespace dpe

#endif  // DPE_ENGINE_INNER_STATES_H_
