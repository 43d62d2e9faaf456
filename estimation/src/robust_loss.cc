#include "dpe/estimation/robust_loss.h"

#include <cmath>

#include "dpe/engine/scene.h"

namespace dpe {

std::string LossTypeName(LossType type) {
  switch (type) {
    case LossType::kHuber:
      return "huber";
    case LossType::kCauchy:
      return "cauchy";
    case LossType::kTukey:
      return "tukey";
    case LossType::kNone:
      break;
  }
  return "none";
}

LossType LossTypeFromName(const std::string& name) {
  for (const LossType type :
       {LossType::kNone, LossType::kHuber, LossType::kCauchy, LossType::kTukey}) {
    if (name == LossTypeName(type)) return type;
  }
  throw SceneError("loss \"" + name +
                   "\" is not known; accepted are none, huber, cauchy, tukey");
}

// For a radial psi(u) = rho'(u^2) u and noise N(0, I) in p = 3 dimensions the variance
// of the location estimate is (E[psi^2] / p) / E[psi'/p + (1 - 1/p) psi/u]^2 (Maronna,
// Robust M-estimators of multivariate location and scatter, 1976); the test solves it
// for 1/0.95.
double RobustLoss::DefaultScale(LossType type) {
  switch (type) {
    case LossType::kHuber:
      return 1.628;
    case LossType::kCauchy:
      return 2.666;
    case LossType::kTukey:
      return 5.490;
    case LossType::kNone:
      break;
  }
  return 1.0;
}

double RobustLoss::Ratio(double x) const {
  switch (type_) {
    case LossType::kHuber:
      return x <= 1.0 ? 1.0 : (2.0 * std::sqrt(x) - 1.0) / x;
    case LossType::kCauchy:
      return x > 0.0 ? std::log1p(x) / x : 1.0;
    case LossType::kTukey:
      return x <= 1.0 ? (3.0 - 3.0 * x + x * x) / 3.0 : 1.0 / (3.0 * x);
    case LossType::kNone:
      break;
  }
  return 1.0;
}

double RobustLoss::Rho(double s) const { return s * Ratio(s / (scale_ * scale_)); }

double RobustLoss::Derivative(double s) const {
  const double x = s / (scale_ * scale_);
  switch (type_) {
    case LossType::kHuber:
      return x <= 1.0 ? 1.0 : 1.0 / std::sqrt(x);
    case LossType::kCauchy:
      return 1.0 / (1.0 + x);
    case LossType::kTukey:
      return x <= 1.0 ? (1.0 - x) * (1.0 - x) : 0.0;
    case LossType::kNone:
      break;
  }
  return 1.0;
}

Eigen::Matrix3d RobustLoss::Apply(Eigen::Ref<Eigen::Vector3d> r) const {
  const double s = r.squaredNorm();
  if (type_ == LossType::kNone || s == 0.0) return Eigen::Matrix3d::Identity();
  const double w = std::sqrt(Ratio(s / (scale_ * scale_)));
  const Eigen::Vector3d direction = r / std::sqrt(s);
  r *= w;
  return w * Eigen::Matrix3d::Identity() +
         (Derivative(s) / w - w) * direction * direction.transpose();
}

}  // namespace dpe
