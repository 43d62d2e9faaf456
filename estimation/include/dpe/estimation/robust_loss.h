// Robust losses: how much an observation far from the model may count.
//
// Of one observed position with whitened residual r (3 numbers), s = |r|^2, the cost is
// 1/2 rho(s) in place of 1/2 s. With x = s / c^2 and c the loss's scale:
//
//   none     rho = s
//   huber    rho = s                          for x <= 1, c^2 (2 sqrt(x) - 1) beyond
//   cauchy   rho = c^2 log(1 + x)
//   tukey    rho = c^2/3 (1 - (1 - x)^3)      for x <= 1, c^2/3 beyond
//
// all with rho'(0) = 1 (Holland and Welsch, Robust regression using iteratively
// reweighted least-squares, 1977; Ceres Solver's loss functions). It is put into the
// residual itself,
//
//   r~ = w r,  w = sqrt(rho / s),   so that |r~|^2 = rho(s)  and
//   dr~/dr = w I + (rho'/w - w) r r^T / s,
//
// which has the eigenvalue rho'/w along r and w across. The cost and its gradient
// rho' r^T dr are exact, J~^T J~ is positive semidefinite as Gauss-Newton needs it, and
// every optimiser, trial point and error bar sees the same cost. (Triggs's correction,
// which Ceres applies to a loss, has rho' across and clips a negative curvature along
// r; Ceres also computes log(1 + x) to an absolute accuracy only, which makes the cost
// 0 where residuals are small.)
#ifndef DPE_ESTIMATION_ROBUST_LOSS_H_
#define DPE_ESTIMATION_ROBUST_LOSS_H_

#include <Eigen/Core>
#include <string>

#include "dpe/estimation/export.h"

namespace dpe {

enum class LossType { kNone, kHuber, kCauchy, kTukey };

// "none", "huber", "cauchy", "tukey".
DPE_ESTIMATION_API std::string LossTypeName(LossType type);

// @throws SceneError naming what is accepted
DPE_ESTIMATION_API LossType LossTypeFromName(const std::string& name);

class DPE_ESTIMATION_API RobustLoss {
 public:
  RobustLoss() = default;  // none
  // @param type   which law
  // @param scale  c, in the residual's unit, > 0
  RobustLoss(LossType type, double scale) : type_(type), scale_(scale) {}

  // The scale at which a location estimate from normal noise of unit variance in three
  // dimensions keeps 95 % of its efficiency: what an outlier's suppression costs where
  // there are none. 1 for kNone.
  static double DefaultScale(LossType type);

  LossType type() const { return type_; }
  double scale() const { return scale_; }

  double Rho(double s) const;         // rho(s), s >= 0
  double Derivative(double s) const;  // rho'(s)

  // Replaces r by w r.
  // @return  the derivative of the result with respect to r
  Eigen::Matrix3d Apply(Eigen::Ref<Eigen::Vector3d> r) const;

 private:
  double Ratio(double x) const;  // rho(s) / s

  LossType type_ = LossType::kNone;
  double scale_ = 1.0;
};

}  // namespace dpe

#endif  // DPE_ESTIMATION_ROBUST_LOSS_H_
