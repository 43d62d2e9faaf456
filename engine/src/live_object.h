// One object of a live simulation: its equations, its state, and how a frame advances
// it.
#ifndef DPE_ENGINE_LIVE_OBJECT_H_
#define DPE_ENGINE_LIVE_OBJECT_H_

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "dpe/engine/scene.h"
#include "dpe/engine/simulator.h"
#include "frame_runner.h"
#include "inner_states.h"
#include "object_system.h"

namespace dpe {

class LiveObject {
 public:
  // `scene` and `options` must outlive the object and stay where they are; their values
  // may change.
  LiveObject(const Scene& scene, const SimulatorOptions& options, int object);
  LiveObject(const LiveObject&) = delete;
  LiveObject& operator=(const LiveObject&) = delete;

  const Eigen::VectorXd& positions() const { return x_; }
  const Eigen::VectorXd& velocities() const { return v_; }

  // Computes the state after frame `frame` + 1, which Accept makes the state at hand.
  RolloutStatus Advance(int frame);
  void Accept();
  // Forgets what a method or a solver remembers of steps that shall not count.
  void ForgetSteps();

  void Restart();
  void SetState(const Eigen::VectorXd& positions, const Eigen::VectorXd& velocities);
  void SetFixedPosition(int vertex, const Eigen::Vector3d& position);
  // Takes masses, stiffnesses, damping, drag and wind from the scene.
  void TakeParameters();
  void TakeColliders() { system_->SetColliders(scene_); }

 private:
  // Makes the equations: at first, and when a force law has to be added to them.
  void Build();

  const Scene& scene_;
  const SimulatorOptions& options_;
  int object_;
  bool has_drag_ = false;
  std::unique_ptr<ObjectSystem> system_;
  std::unique_ptr<FrameRunner> runner_;
  InnerStates inner_;
  Eigen::VectorXd x_, v_, next_x_, next_v_;
  std::vector<DrivenVertex> driven_;
};

}  // namespace dpe

#endif  // DPE_ENGINE_LIVE_OBJECT_H_
