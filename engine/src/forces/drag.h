// Aerodynamic drag of a triangle (a, b, c), the same force on each of its vertices.
//
// With e1 = x_b - x_a, e2 = x_c - x_a, n = e1 x e2 (not normalised), A = |n| / 2 and
// w = wind - (v_a + v_b + v_c) / 3:
//   law "authored":    F = (C/3) A n (n . w),          grows with A^3,
//   law "unit_normal": F = (C/3) A (n/|n|) (n/|n| . w), grows with A.
// Both are F = kappa m^s q n with m = |n|, q = n . w, kappa = C / 6 and s = 1 or -1.
//
// Along a direction (dn, dw), with r = s (n . dn) / m^2, dq = dn . w + n . dw and
// p = kappa m^s:
//   phi = p (zeta n + q dn),   zeta = q + dq + r q.
// Its derivatives, with t = s / m^2:
//   dphi/dn  = p (zeta I + n b^T + dn g^T),   g = w + t q n,
//     b = g + t ((s-2)/s r q + dq) n + t q dn + r w + dw,
//   dphi/d(dn) = p (q I + n g^T),
//   dphi/dw  = p (n (n + r n + dn)^T + dn n^T), of which p n n^T is df/dw, "plain".
// The chain to the edges is n' = e1' x e2 + e1 x e2', and the same for dn. With
// n b^T [e]x = n (b x e)^T, where [e]x is the matrix of (e x .):
//   dphi/de1 = -p ([c2]x + n b2^T + dn g2^T),  dphi/de2 = p ([c1]x + n b1^T + dn g1^T),
//   ci = zeta ei + q dei,  bi = b x ei + g x dei,  gi = g x ei.
//
// The reduced velocity u of element_term.h is the sum v_a + v_b + v_c, w = wind - u
// / 3.
//
// A collapsed triangle (n = 0) catches no air: its force counts as zero around it.
#ifndef DPE_ENGINE_FORCES_DRAG_H_
#define DPE_ENGINE_FORCES_DRAG_H_

#include <array>
#include <string>
#include <vector>

#include "dpe/engine/scene.h"
#include "forces/batch_term.h"

namespace dpe {

class DragLaw {
 public:
  static constexpr int kVertices = 3;
  static constexpr int kCoords = 2;
  static constexpr double kPosition[2][3] = {{-1.0, 1.0, 0.0}, {-1.0, 0.0, 1.0}};
  static constexpr double kVelocity[3] = {1.0, 1.0, 1.0};
  static constexpr double kForce[3] = {1.0, 1.0, 1.0};
  static constexpr int kMatrices = 3;
  static constexpr int kMatrixOf[3] = {0, 1, 2};
  static constexpr double kMatrixSign[3] = {1.0, 1.0, 1.0};
  static constexpr int kParameters = 4;  // the coefficient and the wind's components
  static constexpr ParameterKind kParameterKind[4] = {
      ParameterKind::kDrag, ParameterKind::kWind, ParameterKind::kWind,
      ParameterKind::kWind};
  static constexpr bool kIsShared[4] = {true, true, true, true};

  using Batch = ElementBatch<kCoords, /*kConstants=*/0>;

  // Takes the triangles of `object` that have at least one free vertex.
  DragLaw(const ClothObject& object, AerodynamicsLaw law,
          const ObjectParameters* parameters);

  const std::vector<std::array<int, 3>>& elements() const { return elements_; }
  bool UsesVelocity() const { return true; }
  bool IsSymmetric() const { return parameters_->drag_coefficient == 0.0; }
  int ParameterElement(int p, int /*e*/) const { return p == 0 ? 0 : p - 1; }
  std::string UndefinedReason(const double* /*x*/) const { return {}; }

  void GatherConstants(int /*first*/, Batch* /*batch*/) const {}
  void Values(const Batch& batch, LoopFlags flags, VectorLanes* phi) const;
  void Matrices(const Batch& batch, LoopFlags flags, JacobianFactors factors,
                MatrixLanes* matrices) const;
  void Adjoints(const Batch& batch, LoopFlags flags, VelocityPart part,
                AdjointLanes<2>* out) const;
  void Parameters(const Batch& batch, LoopFlags flags, VectorLanes* out) const;

  // What all triangles share.
  struct Air {
    double authored, unit_normal;  // kappa of the law in force; 0 of the other
    double sign;                   // s
    Vec3 wind;
  };

 private:
  Air AirOf(double coefficient) const;

  std::vector<std::array<int, 3>> elements_;
  const ObjectParameters* parameters_;
  bool unit_normal_;
};

using DragTerm = BatchTerm<DragLaw>;

}  // namespace dpe

#endif  // DPE_ENGINE_FORCES_DRAG_H_
