// Gravity and mass damping of a free vertex: F = m g - alpha m v (Rayleigh damping
// proportional to the current mass). Both are linear, so phi = m g - alpha m (v + dv).
#ifndef DPE_ENGINE_FORCES_GRAVITY_H_
#define DPE_ENGINE_FORCES_GRAVITY_H_

#include <array>
#include <vector>

#include "dpe/engine/scene.h"
#include "forces/element_term.h"

namespace dpe {

class GravityKernel {
 public:
  static constexpr int kVertices = 1;
  static constexpr int kCoords = 1;
  static constexpr double kPosition[1][1] = {{0.0}};  // the same everywhere
  static constexpr double kVelocity[1] = {1.0};
  static constexpr double kForce[1] = {1.0};

  // Takes the free vertices of `object`.
  GravityKernel(const ClothObject& object, const Eigen::Vector3d& gravity,
                const ObjectParameters* parameters)
      : gravity_(gravity), parameters_(parameters) {
    for (int i = 0; i < object.num_vertices(); ++i) {
      if (!object.is_fixed[i]) elements.push_back({i});
    }
  }

  void Value(int e, const ElementInput<1>& in, Eigen::Vector3d* phi) const {
    *phi = Mass(e) * PerMass(in);
  }

  void Expand(int e, const ElementInput<1>& /*in*/, Expansion<1>* out) const {
    out->dq[0].setZero();
    out->plain_du = Eigen::Matrix3d::Identity() * (-parameters_->damping * Mass(e));
    out->du = out->plain_du;
  }

  bool OwnsAny(const ParameterSink& sink) const {
    return sink.Wants(ParameterKind::kMass) || sink.Wants(ParameterKind::kDamping);
  }

  template <class Report>
  void Parameters(int e, const ElementInput<1>& in, const Report& report) const {
    report(ParameterKind::kMass, elements[e][0], PerMass(in));
    report(ParameterKind::kDamping, 0, Eigen::Vector3d(-Mass(e) * Velocity(in)));
  }

  bool IsSymmetric() const { return true; }

  std::vector<std::array<int, 1>> elements;

 private:
  double Mass(int e) const { return parameters_->mass[elements[e][0]]; }
  Eigen::Vector3d PerMass(const ElementInput<1>& in) const {
    return gravity_ - parameters_->damping * Velocity(in);
  }
  static Eigen::Vector3d Velocity(const ElementInput<1>& in) {
    return in.has_direction ? Eigen::Vector3d(in.u + in.du) : in.u;
  }

  Eigen::Vector3d gravity_;  // m/s^2
  const ObjectParameters* parameters_;
};

using GravityTerm = ElementTerm<GravityKernel>;

}  // namespace dpe

#endif  // DPE_ENGINE_FORCES_GRAVITY_H_
