#include "live_object.h"

#include <algorithm>

namespace dpe {

LiveObject::LiveObject(const Scene& scene, const SimulatorOptions& options, int object)
    : scene_(scene), options_(options), object_(object) {
  Build();
  Restart();
}

void LiveObject::Build() {
  const ClothObject& cloth = scene_.objects[object_];
  has_drag_ = cloth.drag_coefficient != 0.0 || cloth.estimate_drag;
  runner_.reset();
  system_ = std::make_unique<ObjectSystem>(scene_, object_, ParameterLayout(scene_),
                                           options_.timings);
  runner_ = std::make_unique<FrameRunner>(scene_, options_, system_.get());
  inner_.Resize(system_->num_coordinates(), scene_.steps_per_frame,
                runner_->num_stages(), 1);
}

void LiveObject::Restart() {
  ForgetSteps();
  driven_.clear();
  system_->SetDrivenVertices(&driven_);
  x_ = next_x_ = system_->initial_positions();
  v_ = next_v_ = system_->initial_velocities();
}

RolloutStatus LiveObject::Advance(int frame) {
  RolloutStatus status;
  status.object = object_;
  const FrameTarget target{x_.data(),      v_.data(), next_x_.data(),
                           next_v_.data(), &inner_,   0};
  const StepOutcome outcome =
      runner_->Run(frame, scene_.steps_per_frame, target, {}, &status.step);
  if (!outcome.ok()) {
    status.code = outcome.code;
    status.reason = outcome.reason;
    status.frame = frame + 1;
  }
  return status;
}

void LiveObject::Accept() {
  x_.swap(next_x_);
  v_.swap(next_v_);
  for (DrivenVertex& driven : driven_) driven.from = driven.to;
}

void LiveObject::ForgetSteps() {
  runner_ = std::make_unique<FrameRunner>(scene_, options_, system_.get());
  system_->solver()->Reset();
}

void LiveObject::SetState(const Eigen::VectorXd& positions,
                          const Eigen::VectorXd& velocities) {
  x_ = positions;
  v_ = velocities;
  for (DrivenVertex& driven : driven_) {
    driven.from = driven.to = x_.segment<3>(3 * driven.vertex);
  }
}

void LiveObject::SetFixedPosition(int vertex, const Eigen::Vector3d& position) {
  const auto found =
      std::lower_bound(driven_.begin(), driven_.end(), vertex,
                       [](const DrivenVertex& d, int v) { return d.vertex < v; });
  if (found != driven_.end() && found->vertex == vertex) {
    found->to = position;
    return;
  }
  driven_.insert(found, {vertex, x_.segment<3>(3 * vertex), position});
}

void LiveObject::TakeParameters() {
  if (!has_drag_ && scene_.objects[object_].drag_coefficient != 0.0) {
    Build();
    system_->SetDrivenVertices(&driven_);
    return;
  }
  system_->SetParameters(scene_);
}

}  // namespace dpe
