#include "step_reader.h"

#include <algorithm>

namespace dpe {
StepReader::StepReader(const ObjectRecord& record)
    : record_(record),
      runner_(*record.scene, *record.options, record.system),
      v0_(record.system->num_coordinates()) {}

StepOutcome StepReader::Rerun(int frame) {
  if (buffered_ == frame) return {};
  const Scene& scene = *record_.scene;
  const int n = record_.system->num_coordinates();
  const int stages = runner_.num_stages();
  buffer_.Resize(n, scene.steps_per_frame, stages, 1);
  x_end_.resize(n);
  v_end_.resize(n);
  FrameTarget target;
  target.x0 = record_.positions->col(frame).data();
  target.v0 = record_.velocities->col(frame).data();
  target.x1 = x_end_.data();
  target.v1 = v_end_.data();
  target.inner = &buffer_;
  // Where the last step leads is known; its stage is not.
  const int num_steps = scene.steps_per_frame - (stages > 1 ? 0 : 1);
  int failed_step = 0;
  StepOutcome outcome = runner_.Run(frame, num_steps, target, {}, &failed_step);
  buffered_ = outcome.ok() ? frame : -1;
  return outcome;
}

StepOutcome StepReader::Read(int s, StepStates* states) {
  if (record_.options->interrupted && record_.options->interrupted()) {
    return {RolloutStatus::Code::kInterrupted, ""};
  }
  const int steps_per_frame = record_.scene->steps_per_frame;
  const int frame = s / steps_per_frame, k = s % steps_per_frame;
  const InnerStates* inner = &record_.tape->inner;
  int slot = frame;
  if (runner_.HasInnerStates() && frame >= inner->num_frames()) {
    const StepOutcome outcome = Rerun(frame);
    if (!outcome.ok()) return outcome;
    inner = &buffer_;
    slot = 0;
  }
  const bool is_first = k == 0, is_last = k == steps_per_frame - 1;
  const double h = record_.scene->step_length();
  const double* x0 =
      is_first ? record_.positions->col(frame).data() : inner->x(slot, k);
  const double* v0 =
      is_first ? record_.velocities->col(frame).data() : inner->v(slot, k);
  const double* x1 =
      is_last ? record_.positions->col(frame + 1).data() : inner->x(slot, k + 1);
  const double* v1 =
      is_last ? record_.velocities->col(frame + 1).data() : inner->v(slot, k + 1);
  // At fixed vertices v0 must hold the velocity over this step.
  std::copy_n(v0, v0_.size(), v0_.data());
  record_.system->SetPrescribedVelocities(h, x0, x1, v0_.data());
  *states = {h, x0, v0_.data(), x1, v1, nullptr, nullptr};
  if (runner_.num_stages() > 1) {
    states->xs = inner->xs(slot, k);
    states->vs = inner->vs(slot, k);
  }
  return {};
}

}  // namespace dpe
