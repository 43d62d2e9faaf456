// A damped spring between two vertices (Provot 1995; damping along the spring as in
// Baraff & Witkin 1998, section 4.5).
//
// With d = x_a - x_b, l = |d|, u = d / l, w = v_a - v_b, rest length L0, stiffness k
// and beta = damping / 2 (Rayleigh damping follows the current stiffness):
//   F_a = k g(d, w),  F_b = -F_a,   g = -T u,   T = l - L0 + beta c,   c = u . w.
//
// Along a direction (dd, dw), with P = I - u u^T:
//   du = P dd / l,  a = u . dd,  dc = du . w + u . dw,  dT = a + beta dc,
//   phi / k = -(T + dT) u - T du.
// Its derivatives, with U = P / l (derivative of u) and
//   V = -(a U + u du^T + du u^T) / l (derivative of du):
//   dphi/dd / -k = (u + du)(u + beta U w)^T + T (U + V)
//                  + u (du + beta (V w + U dw))^T + dT U,
//   dphi/dw / -k = beta ((u + du) u^T + u du^T).
// Both are of the form  gamma I + u b^T + du e^T:
//   dphi/dd: gamma = (T + dT - T a / l) / l,  e = u + beta U w - (T / l) u,
//            b = e + (T / l - gamma) u + (1 - T / l) du + beta (V w + U dw),
//   dphi/dw: gamma = 0,  e = beta u,  b = beta (u + du),
// where the term beta u u^T of the latter is dg/dw, "plain".
#ifndef DPE_ENGINE_FORCES_SPRING_H_
#define DPE_ENGINE_FORCES_SPRING_H_

#include <array>
#include <string>
#include <vector>

#include "dpe/engine/scene.h"
#include "forces/batch_term.h"

namespace dpe {

class SpringLaw {
 public:
  static constexpr int kVertices = 2;
  static constexpr int kCoords = 1;
  static constexpr double kPosition[1][2] = {{1.0, -1.0}};
  static constexpr double kVelocity[2] = {1.0, -1.0};
  static constexpr double kForce[2] = {1.0, -1.0};
  static constexpr int kMatrices = 1;
  static constexpr int kMatrixOf[2] = {0, 0};
  static constexpr double kMatrixSign[2] = {1.0, -1.0};
  static constexpr int kParameters = 2;
  static constexpr ParameterKind kParameterKind[2] = {ParameterKind::kStiffness,
                                                      ParameterKind::kDamping};
  static constexpr bool kIsShared[2] = {false, true};

  using Batch = ElementBatch<kCoords, /*kConstants=*/2>;  // stiffness, rest length

  // Takes the springs of `object` that have at least one free end.
  SpringLaw(const ClothObject& object, const ObjectParameters* parameters);

  const std::vector<std::array<int, 2>>& elements() const { return elements_; }
  bool UsesVelocity() const { return parameters_->damping != 0.0; }
  // The damping part makes df/dx non-symmetric.
  bool IsSymmetric() const { return parameters_->damping == 0.0; }
  int ParameterElement(int p, int e) const { return p == 0 ? springs_[e] : 0; }
  // A spring whose ends coincide has no direction.
  std::string UndefinedReason(const double* x) const;

  void GatherConstants(int first, Batch* batch) const {
    for (int i = 0; i < kBatch; ++i) {
      batch->constants[0].at[i] = parameters_->stiffness[springs_[first + i]];
      batch->constants[1].at[i] = rest_lengths_[first + i];
    }
  }
  void Values(const Batch& batch, LoopFlags flags, VectorLanes* phi) const;
  void Matrices(const Batch& batch, LoopFlags flags, JacobianFactors factors,
                MatrixLanes* matrices) const;
  void Adjoints(const Batch& batch, LoopFlags flags, VelocityPart part,
                AdjointLanes<1>* out) const;
  void Parameters(const Batch& batch, LoopFlags flags, VectorLanes* out) const;

 private:
  double Beta() const { return 0.5 * parameters_->damping; }

  std::vector<std::array<int, 2>> elements_;
  std::vector<int> springs_;  // index into the object's springs; whole batches
  std::vector<double> rest_lengths_;
  const ObjectParameters* parameters_;
};

using SpringTerm = BatchTerm<SpringLaw>;

}  // namespace dpe

#endif  // DPE_ENGINE_FORCES_SPRING_H_
