// Penalty contact of a free vertex with a sphere or a half-space.
//
// Sphere with centre c and radius r, if l = |x - c| < r:  F = K (r - l) (x - c) / l,
//   dF/dx = -K (u u^T - (r - l) (I - u u^T) / l),  u = (x - c) / l.
// Half-space through c with outward normal n, if s = n . (x - c) < 0:  F = -K s n.
//
// The force is continuous but its derivative jumps where contact begins: a derivative
// pass uses the side on which the state is, and differences across the kink disagree
// with it by design.
#ifndef DPE_ENGINE_FORCES_COLLIDER_H_
#define DPE_ENGINE_FORCES_COLLIDER_H_

#include <array>
#include <vector>

#include "dpe/engine/scene.h"
#include "forces/element_term.h"

namespace dpe {

// The outward normal of a plane collider: +y turned by R_y R_x R_z.
Eigen::Vector3d PlaneNormal(const Collider& collider);

class ColliderKernel {
 public:
  static constexpr int kVertices = 1;
  static constexpr int kCoords = 1;
  static constexpr double kPosition[1][1] = {{1.0}};
  static constexpr double kVelocity[1] = {0.0};
  static constexpr double kForce[1] = {1.0};

  // Acts on the free vertices of `object`.
  ColliderKernel(const ClothObject& object, const Collider& collider);

  // Becomes this collider, for the same vertices.
  void SetCollider(const Collider& collider);

  void Value(int e, const ElementInput<1>& in, Eigen::Vector3d* phi) const;
  void Expand(int e, const ElementInput<1>& in, Expansion<1>* out) const;

  // What rounds at x is the product of stiffness and this length (m), |d| and r, of
  // which the force is a difference; 0 without contact.
  double RoundedLength(const Eigen::Vector3d& x) const;
  double stiffness() const { return stiffness_; }

  bool OwnsAny(const ParameterSink& /*sink*/) const { return false; }
  template <class Report>
  void Parameters(int, const ElementInput<1>&, const Report&) const {}
  bool IsSymmetric() const { return true; }

  std::vector<std::array<int, 1>> elements;

 private:
  bool is_sphere_ = false;
  Eigen::Vector3d position_;
  Eigen::Vector3d normal_;  // planes
  double radius_ = 0.0;     // spheres
  double stiffness_ = 0.0;
};

using ColliderTerm = ElementTerm<ColliderKernel>;

}  // namespace dpe

#endif  // DPE_ENGINE_FORCES_COLLIDER_H_
