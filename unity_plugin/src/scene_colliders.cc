// Colliders of a scene under names that stay theirs when others are removed.
#include <algorithm>

#include "call.h"
#include "scene_model.h"

namespace dpe::c {

Collider ToCollider(const dpe_collider& collider) {
  Require(collider.type == DPE_PLANE || collider.type == DPE_SPHERE,
          "the collider's type; accepted are 0 (plane) and 1 (sphere)");
  RequireFinite("the collider's position", collider.position, 3);
  RequireFinite("the collider's rotation", collider.rotation_degrees, 3);
  RequireFinite("the collider's radius", &collider.radius, 1);
  RequireFinite("the collider's stiffness", &collider.stiffness, 1);
  Collider to;
  to.type = static_cast<ColliderType>(collider.type);
  to.position = Eigen::Vector3d::Map(collider.position);
  to.rotation_degrees = Eigen::Vector3d::Map(collider.rotation_degrees);
  if (to.type == ColliderType::kSphere) to.scale.setConstant(2.0 * collider.radius);
  to.stiffness = collider.stiffness;
  return to;
}

dpe_collider FromCollider(const Collider& collider) {
  dpe_collider to{};
  to.type = static_cast<int32_t>(collider.type);
  Eigen::Vector3d::Map(to.position) = collider.position;
  Eigen::Vector3d::Map(to.rotation_degrees) = collider.rotation_degrees;
  to.radius = collider.scale.x() / 2.0;
  to.stiffness = collider.stiffness;
  return to;
}

int SceneModel::ColliderIndex(int id) const {
  const auto found = std::find(collider_ids_.begin(), collider_ids_.end(), id);
  if (found == collider_ids_.end()) {
    throw ApiError(DPE_ERROR_ARGUMENT,
                   "there is no collider with id " + std::to_string(id));
  }
  return static_cast<int>(found - collider_ids_.begin());
}

int SceneModel::AddCollider(const dpe_collider& collider) {
  std::vector<Collider> colliders = now().colliders;
  colliders.push_back(ToCollider(collider));
  collider_ids_.reserve(collider_ids_.size() + 1);
  live_->SetColliders(colliders);
  collider_ids_.push_back(next_collider_id_);
  return next_collider_id_++;
}

void SceneModel::SetCollider(int id, const dpe_collider& collider) {
  std::vector<Collider> colliders = now().colliders;
  colliders[ColliderIndex(id)] = ToCollider(collider);
  live_->SetColliders(colliders);
}

dpe_collider SceneModel::GetCollider(int id) const {
  return FromCollider(now().colliders[ColliderIndex(id)]);
}

void SceneModel::RemoveCollider(int id) {
  const int index = ColliderIndex(id);
  std::vector<Collider> colliders = now().colliders;
  colliders.erase(colliders.begin() + index);
  live_->SetColliders(colliders);
  collider_ids_.erase(collider_ids_.begin() + index);
}

}  // namespace dpe::c
