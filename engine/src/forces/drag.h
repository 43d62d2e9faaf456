// Aerodynamic drag of a triangle (a, b, c), the same force on each of its vertices.
//
// With e1 = x_b - x_a, e2 = x_c - x_a, n = e1 x e2 (not normalised), A = |n| / 2 and
// w = wind - (v_a + v_b + v_c) / 3:
//   law "authored":    F = (C/3) A n (n . w),          grows with A^3,
//   law "unit_normal": F = (C/3) A (n/|n|) (n/|n| . w), grows with A.
// Both are F = kappa m^s n q with m = |n|, q = n . w, kappa = C / 6 and s = 1 or -1.
//
// Along a direction (dn, dw), with r = n . dn and dq = dn . w + n . dw:
//   dF = kappa (s m^(s-2) r q n + m^s (q dn + dq n)).
// Derivatives: dF/dn = kappa (s m^(s-2) q n n^T + m^s (q I + n w^T)), dF/dw = kappa
// m^s n n^T, and those of dF:
//   d(dF)/dn = kappa (s (s-2) m^(s-4) r q n n^T
//              + s m^(s-2) (q n dn^T + r n w^T + r q I + (q dn + dq n) n^T)
//              + m^s (dn w^T + n dw^T + dq I)),
//   d(dF)/dw = kappa (s m^(s-2) r n n^T + m^s (dn n^T + n dn^T)).
// The chain to the edges is n' = e1' x e2 + e1 x e2', and the same for dn.
#ifndef DPE_ENGINE_FORCES_DRAG_H_
#define DPE_ENGINE_FORCES_DRAG_H_

#include <array>
#include <vector>

#include "dpe/engine/scene.h"
#include "forces/element_term.h"

namespace dpe {

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

using DragTerm = ElementTerm<DragKernel>;

}  // namespace dpe

#endif  // DPE_ENGINE_FORCES_DRAG_H_
