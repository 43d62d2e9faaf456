// A scene that moves and may be changed, without threads: the live simulation and what
// the C interface adds to it, which is colliders with names and vertices that are fixed
// and freed on the way.
//
// Fixing or freeing a vertex changes the unknowns, so the simulation is made anew from
// its present state: the same springs with the same rest lengths, positions and
// velocities as they are, and what is left of prescribed paths.
#ifndef DPE_UNITY_SCENE_MODEL_H_
#define DPE_UNITY_SCENE_MODEL_H_

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "dpe/c/changes.h"
#include "dpe/engine/live_simulation.h"
#include "dpe/engine/scene.h"

namespace dpe::c {

class SceneModel {
 public:
  // @param interrupted  ends a frame that is being computed; must outlive the model
  // @throws SceneError
  SceneModel(const Scene& scene, const std::atomic<bool>* interrupted);

  // Where it began; its parameters are those of the file.
  const Scene& initial() const { return initial_; }
  // The initial scene with parameters, wind and colliders as they are now.
  Scene Changed() const;
  const Scene& now() const { return live_->scene(); }
  const Eigen::VectorXd& positions(int object) const {
    return live_->positions(object);
  }
  std::int64_t frame() const { return frame_; }

  // As LiveSimulation::AdvanceFrame, but a failure names the frame since the start.
  RolloutStatus Advance();
  void Restart();

  // All of them: @throws ApiError or SceneError, and then change nothing.
  std::vector<double> Parameter(int object, int kind) const;
  void SetParameter(int object, int kind, const double* values, int count);
  void TakeParameters(const Scene& scene);
  int AddCollider(const dpe_collider& collider);
  void SetCollider(int id, const dpe_collider& collider);
  dpe_collider GetCollider(int id) const;
  void RemoveCollider(int id);
  const std::vector<int>& collider_ids() const { return collider_ids_; }
  void MoveVertices(int object, const int* vertices, const double* positions,
                    int count);
  void SetFixed(int object, int vertex, bool is_fixed);

 private:
  const ClothObject& At(int object) const;
  int ColliderIndex(int id) const;
  // The scene as one that begins now.
  Scene Continued() const;
  std::unique_ptr<LiveSimulation> MakeLive(const Scene& scene) const;

  Scene initial_;
  const std::atomic<bool>* interrupted_;
  std::unique_ptr<LiveSimulation> live_;
  std::int64_t frame_ = 0;
  bool was_rebuilt_ = false;  // live_ does not begin with initial_
  std::vector<int> collider_ids_;
  int next_collider_id_ = 0;
};

// @throws ApiError for a type that is neither plane nor sphere
Collider ToCollider(const dpe_collider& collider);
dpe_collider FromCollider(const Collider& collider);

}  // namespace dpe::c

#endif  // DPE_UNITY_SCENE_MODEL_H_
