#include "dpe/estimation/trajectory_cost_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

#include "dpe/engine/derivative_checker.h"

namespace dpe {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Columns shorter than this fraction of the longest are compared with that instead of
// with themselves: their difference quotients are mostly rounding.
constexpr double kNegligible = 1e-6;

using State = TrajectoryCost::StateReference;

std::string Name(const State& state) {
  return "object " + std::to_string(state.object) + " at frame " +
         std::to_string(state.frame);
}

class Checker {
 public:
  Checker(const TrajectoryCost& cost, const Trajectory& trajectory)
      : cost_(cost), trajectory_(trajectory), residuals_(cost.num_residuals()) {}

  TrajectoryCostCheck Run(double tolerance) {
    message_ = FindProblem();
    if (message_.empty()) {
      CompareAll();
      if (!(result_.relative_error <= tolerance)) DescribeWorst(tolerance);
    }
    result_.ok = message_.empty();
    if (result_.ok) {
      std::ostringstream text;
      text << "the derivative agrees with central differences to "
           << result_.relative_error;
      message_ = text.str();
    }
    result_.message = message_;
    return result_;
  }

 private:
  // What is wrong before any derivative is compared; empty: nothing.
  std::string FindProblem() {
    if (cost_.num_residuals() <= 0) return "the cost has no residuals";
    for (const State& state : cost_.states()) {
      if (!Exists(state)) {
        return "the cost lists " + Name(state) + ", which the trajectory does not hold";
      }
    }
    if (!Evaluate(&residuals_)) return "the cost cannot be evaluated on the trajectory";
    if (!residuals_.allFinite()) return "a residual is not finite";
    Eigen::VectorXd again(residuals_.size());
    if (!cost_.Evaluate(trajectory_, again.data(), &derivatives_)) {
      return "the cost can be evaluated without derivatives, but not with them";
    }
    if (!((again - residuals_).norm() <= 1e-12 * residuals_.norm())) {
      return "the residuals differ when derivatives are asked for";
    }
    for (const StateDerivative& derivative : derivatives_) {
      const std::string problem = FindProblemOf(derivative);
      if (!problem.empty()) return problem;
    }
    return ReadsOtherStates() ? "the cost reads states that it does not list" : "";
  }

  bool Exists(const State& state) const {
    return state.object >= 0 && state.frame >= 0 &&
           state.object < static_cast<int>(trajectory_.positions.size()) &&
           state.frame < trajectory_.positions[state.object].cols() &&
           trajectory_.velocities[state.object].cols() ==
               trajectory_.positions[state.object].cols();
  }

  bool IsListed(int object, int frame) const {
    return std::any_of(
        cost_.states().begin(), cost_.states().end(),
        [&](const State& s) { return s.object == object && s.frame == frame; });
  }

  std::string FindProblemOf(const StateDerivative& d) const {
    const State state = {d.object, d.frame};
    if (!IsListed(d.object, d.frame)) {
      return "there is a derivative with respect to " + Name(state) +
             ", which the cost does not list";
    }
    const Eigen::Index size = trajectory_.positions[d.object].rows();
    const bool has_velocity = d.d_velocity.rows() > 0;
    if (d.d_position.cols() != size || (has_velocity && d.d_velocity.cols() != size) ||
        (has_velocity && d.d_velocity.rows() != d.d_position.rows())) {
      std::ostringstream text;
      text << "the derivative with respect to " << Name(state)
           << " has a d_position of size " << d.d_position.rows() << " x "
           << d.d_position.cols() << " and a d_velocity of size " << d.d_velocity.rows()
           << " x " << d.d_velocity.cols() << "; accepted are rows x " << size
           << " for both, and 0 x 0 for the latter";
      return text.str();
    }
    if (d.first_row < 0 || d.first_row + d.d_position.rows() > residuals_.size()) {
      std::ostringstream text;
      text << "the derivative with respect to " << Name(state) << " is for residuals "
           << d.first_row << " to " << d.first_row + d.d_position.rows() - 1
           << "; accepted are 0 to " << residuals_.size() - 1;
      return text.str();
    }
    return "";
  }

  bool Evaluate(Eigen::VectorXd* residuals) const {
    residuals->resize(cost_.num_residuals());
    return cost_.Evaluate(trajectory_, residuals->data(), nullptr);
  }

  // Replaces everything that is not listed by NaN, which then must not show.
  bool ReadsOtherStates() {
    const Trajectory original = trajectory_;
    for (size_t object = 0; object < trajectory_.positions.size(); ++object) {
      for (int f = 0; f < trajectory_.positions[object].cols(); ++f) {
        if (IsListed(static_cast<int>(object), f)) continue;
        trajectory_.positions[object].col(f).setConstant(kNaN);
        trajectory_.velocities[object].col(f).setConstant(kNaN);
      }
    }
    Eigen::VectorXd residuals;
    const bool is_same = Evaluate(&residuals) && residuals == residuals_;
    trajectory_ = original;
    return !is_same;
  }

  // The derivative with respect to one state: 3N columns for positions, then 3N for
  // velocities.
  Eigen::MatrixXd Jacobian(const State& state) const {
    const Eigen::Index size = trajectory_.positions[state.object].rows();
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(residuals_.size(), 2 * size);
    for (const StateDerivative& d : derivatives_) {
      if (d.object != state.object || d.frame != state.frame) continue;
      const Eigen::Index rows = d.d_position.rows();
      jacobian.block(d.first_row, 0, rows, size) += Eigen::MatrixXd(d.d_position);
      if (d.d_velocity.rows() == 0) continue;
      jacobian.block(d.first_row, size, rows, size) += Eigen::MatrixXd(d.d_velocity);
    }
    return jacobian;
  }

  void CompareAll() {
    double longest = 0.0;
    for (const State& state : cost_.states()) {
      longest = std::max(longest, Jacobian(state).colwise().norm().maxCoeff());
    }
    for (const State& state : cost_.states()) CompareState(state, longest);
  }

  void CompareState(const State& state, double longest) {
    const Eigen::MatrixXd jacobian = Jacobian(state);
    const int size = static_cast<int>(jacobian.cols() / 2);
    for (int column = 0; column < 2 * size; ++column) {
      const bool is_velocity = column >= size;
      auto& states = is_velocity ? trajectory_.velocities : trajectory_.positions;
      const int row = column % size;
      const Eigen::VectorXd numeric =
          Difference(jacobian.col(column), &states[state.object](row, state.frame));
      const Eigen::VectorXd difference = jacobian.col(column) - numeric;
      const double error =
          difference.norm() / std::max({numeric.norm(), kNegligible * longest,
                                        std::numeric_limits<double>::min()});
      // Not a number, where no difference quotient could be formed, counts as worst.
      if (error <= result_.relative_error && result_.worst.residual >= 0) continue;
      if (std::isnan(result_.relative_error)) continue;
      int residual = 0;
      difference.cwiseAbs().maxCoeff(&residual);
      result_.relative_error = error;
      result_.worst = {residual,
                       state.object,
                       state.frame,
                       row / 3,
                       "xyz"[row % 3],
                       is_velocity,
                       jacobian(residual, column),
                       numeric[residual]};
    }
  }

  // d residuals / d *coordinate.
  Eigen::VectorXd Difference(const Eigen::VectorXd& analytic, double* coordinate) {
    const double original = *coordinate;
    const auto residuals_at = [&](const Eigen::VectorXd& x) {
      *coordinate = x[0];
      Eigen::VectorXd residuals;
      if (!Evaluate(&residuals)) residuals.setConstant(kNaN);
      return residuals;
    };
    const DerivativeCheck check =
        CheckDirectionalDerivative(residuals_at, Eigen::VectorXd::Constant(1, original),
                                   Eigen::VectorXd::Ones(1), analytic);
    *coordinate = original;
    if (check.numeric.size() > 0) return check.numeric;
    return Eigen::VectorXd::Constant(analytic.size(), kNaN);
  }

  void DescribeWorst(double tolerance) {
    const TrajectoryCostCheck::Entry& worst = result_.worst;
    std::ostringstream text;
    text << "the derivative of residual " << worst.residual << " with respect to "
         << (worst.is_velocity ? "velocity " : "position ") << worst.axis
         << " of vertex " << worst.vertex << ", " << Name({worst.object, worst.frame})
         << ", is " << worst.analytic << ", but central differences give "
         << worst.numeric << " (relative error " << result_.relative_error
         << ", accepted is " << tolerance << ")";
    message_ = text.str();
  }

  const TrajectoryCost& cost_;
  Trajectory trajectory_;
  Eigen::VectorXd residuals_;
  std::vector<StateDerivative> derivatives_;
  TrajectoryCostCheck result_;
  std::string message_;
};

}  // namespace

TrajectoryCostCheck CheckTrajectoryCost(const TrajectoryCost& cost,
                                        const Trajectory& trajectory,
                                        double tolerance) {
  return Checker(cost, trajectory).Run(tolerance);
}

}  // namespace dpe
