// Springs and drag one element at a time, in Eigen's matrices and with every term
// written out as a sum of products: what the batched laws of forces/spring.h and
// forces/drag.h are compared with. The equations are in those headers.
#ifndef DPE_TESTS_ENGINE_REFERENCE_KERNELS_H_
#define DPE_TESTS_ENGINE_REFERENCE_KERNELS_H_

#include <array>
#include <vector>

#include "dpe/engine/scene.h"
#include "forces/element_term.h"

namespace dpe::test {

class SpringKernel {
 public:
  static constexpr int kVertices = 2;
  static constexpr int kCoords = 1;
  static constexpr double kPosition[1][2] = {{1.0, -1.0}};
  static constexpr double kVelocity[2] = {1.0, -1.0};
  static constexpr double kForce[2] = {1.0, -1.0};

  // Takes the springs of `object` that have at least one free end.
  SpringKernel(const ClothObject& object, const ObjectParameters* parameters);

  void Value(int e, const ElementInput<1>& in, Eigen::Vector3d* phi) const;
  void Expand(int e, const ElementInput<1>& in, Expansion<1>* out) const;

  bool OwnsAny(const ParameterSink& sink) const {
    return sink.Wants(ParameterKind::kStiffness) || sink.Wants(ParameterKind::kDamping);
  }

  template <class Report>
  void Parameters(int e, const ElementInput<1>& in, const Report& report) const {
    Eigen::Vector3d per_stiffness, per_beta;
    PerStiffness(e, in, &per_stiffness, &per_beta);
    report(ParameterKind::kStiffness, springs_[e], per_stiffness);
    report(ParameterKind::kDamping, 0, 0.5 * Stiffness(e) * per_beta);
  }

  // The damping part makes df/dx non-symmetric.
  bool IsSymmetric() const { return parameters_->damping == 0.0; }

  std::vector<std::array<int, 2>> elements;

 private:
  double Stiffness(int e) const { return parameters_->stiffness[springs_[e]]; }
  // phi / k, and its derivative with respect to beta.
  void PerStiffness(int e, const ElementInput<1>& in, Eigen::Vector3d* phi,
                    Eigen::Vector3d* per_beta) const;

  const ObjectParameters* parameters_;
  std::vector<int> springs_;  // index into the object's springs
  std::vector<double> rest_lengths_;
};

class DragKernel {
 public:
  static constexpr int kVertices = 3;
  static constexpr int kCoords = 2;
  static constexpr double kPosition[2][3] = {{-1.0, 1.0, 0.0}, {-1.0, 0.0, 1.0}};
  static constexpr double kVelocity[3] = {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0};
  static constexpr double kForce[3] = {1.0, 1.0, 1.0};

  // Takes the triangles of `object` that have at least one free vertex.
  DragKernel(const ClothObject& object, AerodynamicsLaw law,
             const ObjectParameters* parameters);

  void Value(int e, const ElementInput<2>& in, Eigen::Vector3d* phi) const;
  void Expand(int e, const ElementInput<2>& in, Expansion<2>* out) const;

  bool OwnsAny(const ParameterSink& sink) const {
    return sink.Wants(ParameterKind::kDrag) || sink.Wants(ParameterKind::kWind);
  }

  template <class Report>
  void Parameters(int e, const ElementInput<2>& in, const Report& report) const {
    Eigen::Vector3d per_coefficient;
    PerCoefficient(in, &per_coefficient);
    report(ParameterKind::kDrag, 0, per_coefficient);
    Expansion<2> expansion;
    Expand(e, in, &expansion);
    // u enters as wind - u only.
    for (int c = 0; c < 3; ++c) {
      report(ParameterKind::kWind, c, Eigen::Vector3d(-expansion.du.col(c)));
    }
  }

  bool IsSymmetric() const { return parameters_->drag_coefficient == 0.0; }

  std::vector<std::array<int, 3>> elements;

 private:
  void PerCoefficient(const ElementInput<2>& in, Eigen::Vector3d* phi) const;

  const ObjectParameters* parameters_;
  bool unit_normal_;
};

}  // namespace dpe::test

#endif  // DPE_TESTS_ENGINE_REFERENCE_KERNELS_H_
