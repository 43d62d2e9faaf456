// The one finite-difference checker: every derivative of the project, and those of its
// users' residuals, are compared with central differences through it.
#ifndef DPE_ENGINE_DERIVATIVE_CHECKER_H_
#define DPE_ENGINE_DERIVATIVE_CHECKER_H_

#include <Eigen/Core>
#include <functional>
#include <ostream>
#include <vector>

#include "dpe/engine/export.h"

namespace dpe {

using VectorFunction = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

struct DerivativeCheck {
  // |difference quotient - analytic| / |difference quotient|, Euclidean norms, at the
  // step where it is least.
  double relative_error = 0.0;
  double step = 0.0;
  double norm = 0.0;        // of the difference quotient
  Eigen::VectorXd numeric;  // the difference quotient; empty if it was never finite
};

DPE_ENGINE_API std::ostream& operator<<(std::ostream& out,
                                        const DerivativeCheck& check);

// Compares `analytic`, claimed to be the derivative of `f` at `x` along `direction`,
// with fourth-order central differences
//   (8 (f(x + s d) - f(x - s d)) - (f(x + 2 s d) - f(x - 2 s d))) / (12 s).
// The error of a difference quotient has a minimum over s between truncation and
// rounding whose place is not known beforehand, so a range of steps is tried and the
// best agreement reported. A wrong derivative agrees at no step.
//
// @param f          any function of x
// @param x          where it is differentiated
// @param direction  d, as many numbers as x
// @param analytic   the claim, as many numbers as f has values
// @param steps      values of s, in units of the direction; empty: 1e-2 ... 1e-9
DPE_ENGINE_API DerivativeCheck CheckDirectionalDerivative(
    const VectorFunction& f, const Eigen::VectorXd& x, const Eigen::VectorXd& direction,
    const Eigen::VectorXd& analytic, const std::vector<double>& steps = {});

// The largest relative error over the columns of a Jacobian (rows: outputs of f,
// columns: coordinates of x), each column compared as above along its unit vector
// scaled by max(|x_j|, 1). Columns whose analytic and numeric norms are both below
// `negligible` times the largest column count as equal.
DPE_ENGINE_API DerivativeCheck CheckJacobian(const VectorFunction& f,
                                             const Eigen::VectorXd& x,
                                             const Eigen::MatrixXd& analytic,
                                             double negligible = 1e-12);

}  // namespace dpe

#endif  // DPE_ENGINE_DERIVATIVE_CHECKER_H_
