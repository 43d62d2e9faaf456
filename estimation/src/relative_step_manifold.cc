#include "relative_step_manifold.h"

#include <Eigen/Core>
#include <cmath>

namespace dpe {
namespace {

const double kLn2 = std::log(2.0);

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace

bool RelativeStepManifold::Plus(const double* x, const double* delta,
                                double* x_plus_delta) const {
  for (int i = 0; i < size_; ++i) {
    const double d = delta[i];
    x_plus_delta[i] =
        x[i] + (d >= -0.5 ? std::log1p(d) : -kLn2 - std::log1p(-2.0 * (d + 0.5)));
  }
  return true;
}

bool RelativeStepManifold::PlusJacobian(const double* /*x*/, double* jacobian) const {
  Eigen::Map<RowMajor>(jacobian, size_, size_).setIdentity();
  return true;
}

bool RelativeStepManifold::Minus(const double* y, const double* x,
                                 double* y_minus_x) const {
  for (int i = 0; i < size_; ++i) {
    const double change = y[i] - x[i];
    y_minus_x[i] = change >= -kLn2 ? std::expm1(change)
                                   : -0.5 - 0.5 * std::expm1(-(change + kLn2));
  }
  return true;
}

bool RelativeStepManifold::MinusJacobian(const double* /*x*/, double* jacobian) const {
  Eigen::Map<RowMajor>(jacobian, size_, size_).setIdentity();
  return true;
}

}  // namespace dpe
