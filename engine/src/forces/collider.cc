#include "forces/collider.h"

#include <Eigen/Geometry>

namespace dpe {

Eigen::Vector3d PlaneNormal(const Collider& collider) {
  const Eigen::Vector3d radians = collider.rotation_degrees * (EIGEN_PI / 180.0);
  return Eigen::AngleAxisd(radians.y(), Eigen::Vector3d::UnitY()) *
         (Eigen::AngleAxisd(radians.x(), Eigen::Vector3d::UnitX()) *
          (Eigen::AngleAxisd(radians.z(), Eigen::Vector3d::UnitZ()) *
           Eigen::Vector3d::UnitY()));
}

ColliderKernel::ColliderKernel(const ClothObject& object, const Collider& collider) {
  SetCollider(collider);
  for (int i = 0; i < object.num_vertices(); ++i) {
    if (!object.is_fixed[i]) elements.push_back({i});
  }
}

void ColliderKernel::SetCollider(const Collider& collider) {
  is_sphere_ = collider.type == ColliderType::kSphere;
  position_ = collider.position;
  normal_ = PlaneNormal(collider);
  radius_ = 0.5 * collider.scale.x();
  stiffness_ = collider.stiffness;
}

void ColliderKernel::Value(int /*e*/, const ElementInput<1>& in,
                           Eigen::Vector3d* phi) const {
  const Eigen::Vector3d d = in.q[0] - position_;
  phi->setZero();
  if (!is_sphere_) {
    const double depth = -normal_.dot(d);
    if (depth <= 0.0) return;
    *phi = (stiffness_ * depth) * normal_;
    if (in.has_direction) *phi -= (stiffness_ * normal_.dot(in.dq[0])) * normal_;
    return;
  }
  const double length = d.norm();
  const double depth = radius_ - length;
  if (depth <= 0.0 || length == 0.0) return;  // at the centre no direction is better
  const Eigen::Vector3d u = d / length;
  *phi = (stiffness_ * depth) * u;
  if (!in.has_direction) return;
  const double rate = u.dot(in.dq[0]);
  *phi += stiffness_ * ((depth / length) * (in.dq[0] - rate * u) - rate * u);
}

double ColliderKernel::RoundedLength(const Eigen::Vector3d& x) const {
  const Eigen::Vector3d d = x - position_;
  if (!is_sphere_) return normal_.dot(d) < 0.0 ? d.norm() : 0.0;
  const double length = d.norm();
  return length < radius_ ? length + radius_ : 0.0;
}

void ColliderKernel::Expand(int /*e*/, const ElementInput<1>& in,
                            Expansion<1>* out) const {
  out->dq[0].setZero();
  out->du.setZero();
  out->plain_du.setZero();
  const Eigen::Vector3d d = in.q[0] - position_;
  if (!is_sphere_) {
    if (normal_.dot(d) < 0.0) {
      out->dq[0] = -stiffness_ * normal_ * normal_.transpose();
    }
    return;
  }
  const double length = d.norm();
  const double depth = radius_ - length;
  if (depth <= 0.0 || length == 0.0) return;
  // The spring's expansion with tension l - r and no damping, see spring.h.
  const Eigen::Vector3d u = d / length;
  const Eigen::Matrix3d uut = u * u.transpose();
  const Eigen::Matrix3d turn_of_d = (Eigen::Matrix3d::Identity() - uut) / length;
  out->dq[0] = stiffness_ * (depth * turn_of_d - uut);
  if (!in.has_direction) return;
  const double rate = u.dot(in.dq[0]);
  const Eigen::Vector3d turn = turn_of_d * in.dq[0];
  const Eigen::Matrix3d u_turn = u * turn.transpose();
  const Eigen::Matrix3d turn_of_d2 =
      -(rate * turn_of_d + u_turn + u_turn.transpose()) / length;
  out->dq[0] += stiffness_ *
                (depth * turn_of_d2 - rate * turn_of_d - u_turn - u_turn.transpose());
}

}  // namespace dpe
