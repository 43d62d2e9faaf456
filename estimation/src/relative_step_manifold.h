// Steps of logarithms of positive quantities that change the quantities themselves in
// proportion.
//
// An optimiser's linear model holds for a step d of the coordinate q = ln p. Of the
// many ways to take that step, all the same to first order, this one moves along a
// straight line in p:
//
//   q (+) d = ln(p (1 + d)) = q + ln(1 + d),          d >= -1/2,
//           = q - ln 2 - ln(1 - 2 (d + 1/2)),         d < -1/2,
//
// the second line continuing the first with the same slope, so that p stays positive
// whatever the step. Forces are linear in stiffness, and over a short time motion
// hardly differs from linear in forces: with hundreds of stiffnesses that make up for
// each other, a step of 0.1 along q + d leaves the straight valley of the cost by
// second-order terms (d^2/2) of the stiff directions that outweigh what the soft ones
// gain. (Retractions: Absil, Mahony & Sepulchre, Optimization Algorithms on Matrix
// Manifolds, 2008, section 4.1.)
//
// The differential at d = 0 is the identity, so Jacobians with respect to q serve as
// they are.
#ifndef DPE_ESTIMATION_RELATIVE_STEP_MANIFOLD_H_
#define DPE_ESTIMATION_RELATIVE_STEP_MANIFOLD_H_

#include <ceres/manifold.h>

namespace dpe {

class RelativeStepManifold final : public ceres::Manifold {
 public:
  explicit RelativeStepManifold(int size) : size_(size) {}

  int AmbientSize() const override { return size_; }
  int TangentSize() const override { return size_; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;

 private:
  int size_;
};

}  // namespace dpe

#endif  // DPE_ESTIMATION_RELATIVE_STEP_MANIFOLD_H_
