#include "dpe/engine/derivative_checker.h"

#include <cmath>
#include <limits>

namespace dpe {

std::ostream& operator<<(std::ostream& out, const DerivativeCheck& check) {
  return out << "relative error " << check.relative_error << " at step " << check.step
             << ", norm " << check.norm;
}

DerivativeCheck CheckDirectionalDerivative(const VectorFunction& f,
                                           const Eigen::VectorXd& x,
                                           const Eigen::VectorXd& direction,
                                           const Eigen::VectorXd& analytic,
                                           const std::vector<double>& steps) {
  static const std::vector<double> kSteps = {1e-2, 1e-3, 1e-4, 1e-5,
                                             1e-6, 1e-7, 1e-8, 1e-9};
  DerivativeCheck best;
  best.relative_error = std::numeric_limits<double>::infinity();
  for (double s : steps.empty() ? kSteps : steps) {
    const auto difference = [&](double t) -> Eigen::VectorXd {
      return f(x + t * direction) - f(x - t * direction);
    };
    const Eigen::VectorXd numeric =
        (8.0 * difference(s) - difference(2.0 * s)) / (12.0 * s);
    const double norm = numeric.norm();
    const double error = (numeric - analytic).norm() /
                         std::max(norm, std::numeric_limits<double>::min());
    if (std::isnan(error)) continue;
    if (best.numeric.size() == 0 || error < best.relative_error) {
      best = {error, s, norm, numeric};
    }
    if (best.relative_error < 1e-9) break;
  }
  return best;
}

DerivativeCheck CheckJacobian(const VectorFunction& f, const Eigen::VectorXd& x,
                              const Eigen::MatrixXd& analytic, double negligible) {
  const double largest = analytic.colwise().norm().maxCoeff();
  DerivativeCheck worst;
  for (int j = 0; j < x.size(); ++j) {
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(x.size(), j);
    const double scale = std::max(std::abs(x[j]), 1.0);
    const DerivativeCheck check =
        CheckDirectionalDerivative(f, x, scale * unit, scale * analytic.col(j));
    const bool both_negligible = check.norm <= negligible * largest * scale &&
                                 analytic.col(j).norm() <= negligible * largest;
    if (!both_negligible && check.relative_error > worst.relative_error) worst = check;
  }
  return worst;
}

}  // namespace dpe
