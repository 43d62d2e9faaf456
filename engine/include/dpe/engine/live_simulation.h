// A simulation that goes on one frame at a time, without an end, and whose parameters,
// surroundings and fixed vertices may change on its way: for programs that show or
// drive a cloth while it moves.
//
// A frame is the very frame that Simulator::Simulate computes: without changes the
// states are the same, bit for bit, whichever integration method. What is set takes
// effect with the frame that follows.
//
// Units, layouts and what is accepted are those of scene.h; a setter throws a
// SceneError for what a scene file could not say either, and then changes nothing. One
// thread at a time may call.
#ifndef DPE_ENGINE_LIVE_SIMULATION_H_
#define DPE_ENGINE_LIVE_SIMULATION_H_

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "dpe/engine/export.h"
#include "dpe/engine/scene.h"
#include "dpe/engine/simulator.h"
#include "dpe/engine/trajectory.h"

namespace dpe {

class LiveObject;

class DPE_ENGINE_API LiveSimulation {
 public:
  // Of the options, `only_estimated_objects` and `memory_limit_bytes` mean nothing
  // here: all objects are simulated, and nothing is kept.
  // @throws SceneError if the scene is not valid (see ValidateScene).
  explicit LiveSimulation(const Scene& scene, const SimulatorOptions& options = {});
  ~LiveSimulation();
  LiveSimulation(const LiveSimulation&) = delete;
  LiveSimulation& operator=(const LiveSimulation&) = delete;

  // The scene with what was set since: what to save, to have the same simulation again.
  const Scene& scene() const { return scene_; }
  int num_objects() const { return static_cast<int>(objects_.size()); }
  // Frames since the start, and the time that they took, s.
  int frame() const { return frame_; }
  double time() const { return frame_ * scene_.delta; }

  // The state now, 3N, xyz interleaved, m and m/s. References stay valid; their values
  // change with AdvanceFrame.
  const Eigen::VectorXd& positions(int object) const;
  const Eigen::VectorXd& velocities(int object) const;

  // Simulates one frame (`steps_per_frame` steps). After a failure the state is that
  // before the call, and the next call tries again, perhaps with other parameters.
  RolloutStatus AdvanceFrame();

  // Back to the initial state of the scene, with the parameters, wind and colliders as
  // they are now; fixed vertices follow the scene's paths again.
  void Restart();

  // Puts an object into a state, 3N each. The velocities of fixed vertices are not
  // used.
  void SetState(int object, const Eigen::VectorXd& positions,
                const Eigen::VectorXd& velocities);

  // Where a fixed vertex is at the end of the next frame, m: it goes there along a
  // straight line and then stays, in place of the path that the scene may have for it.
  void SetFixedPosition(int object, int vertex, const Eigen::Vector3d& position);

  void SetMass(int object, const Eigen::VectorXd& mass);            // kg, per vertex
  void SetStiffness(int object, const Eigen::VectorXd& stiffness);  // N/m, per spring
  void SetDamping(int object, double damping);
  void SetDragCoefficient(int object, double drag_coefficient);
  void SetWind(const Eigen::Vector3d& wind);  // m/s
  // All colliders; as many as before or not.
  void SetColliders(const std::vector<Collider>& colliders);

 private:
  LiveObject& At(int object, const char* what);
  void TakeParameters(int object);

  Scene scene_;
  SimulatorOptions options_;
  std::vector<std::unique_ptr<LiveObject>> objects_;
  std::vector<RolloutStatus> statuses_;
  int frame_ = 0;
};

}  // namespace dpe

#endif  // DPE_ENGINE_LIVE_SIMULATION_H_
