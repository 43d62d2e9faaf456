// A damped spring between two vertices (Provot 1995; damping along the spring as in
// Baraff & Witkin 1998, section 4.5).
//
// With d = x_a - x_b, l = |d|, u = d / l, w = v_a - v_b, rest length L0, stiffness k
// and beta = damping / 2 (Rayleigh damping follows the current stiffness):
//   F_a = k g(d, w),  F_b = -F_a,   g = -(a + beta c) u,  a = l - L0,  c = u . w.
//
// Along a direction (dd, dw), with P = I - u u^T:
//   du = P dd / l,  da = u . dd,  dc = du . w + u . dw,
//   phi = g - (da + beta dc) u - (a + beta c) du.
// Its derivatives, with U = P / l (derivative of u) and
//   V = -(da U + u du^T + du u^T) / l (derivative of du):
//   dphi/dd = -(u + du)(u + beta U w)^T - (a + beta c)(U + V)
//             - u (du + beta (V w + U dw))^T - (da + beta dc) U,
//   dphi/dw = -beta ((u + du) u^T + u du^T).
#ifndef DPE_ENGINE_FORCES_SPRING_H_
#define DPE_ENGINE_FORCES_SPRING_H_

#include <array>
#include <vector>

#include "dpe/engine/scene.h"
#include "forces/element_term.h"

namespace dpe {

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

using SpringTerm = ElementTerm<SpringKernel>;

}  // namespace dpe

#endif  // DPE_ENGINE_FORCES_SPRING_H_
