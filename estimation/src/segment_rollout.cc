#include "segment_rollout.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dpe {
namespace {

// Of a pass that failed, or whose result is not finite in the units of the unknowns.
std::string DerivativeMessage(const Sensitivity& sensitivity) {
  return sensitivity.ok() ? "the derivatives left the range of finite numbers"
                          : sensitivity.status().Message();
}

}  // namespace

SegmentRollout::SegmentRollout(const Scene& scene,
                               std::vector<const TrajectoryCost*> costs,
                               const SimulatorOptions& options)
    : simulator_(scene, options), costs_(std::move(costs)) {
  for (const TrajectoryCost* cost : costs_) {
    first_rows_.push_back(num_residuals_);
    num_residuals_ += cost->num_residuals();
    last_frames_.push_back(0);
    for (const TrajectoryCost::StateReference& state : cost->states()) {
      if (state.object < 0 || state.object >= static_cast<int>(scene.objects.size()) ||
          !simulator_.is_simulated(state.object) || state.frame < 0) {
        throw SceneError("a cost reads object " + std::to_string(state.object) +
                         " at frame " + std::to_string(state.frame) +
                         ", which is not simulated; accepted are objects with an "
                         "estimated parameter and frames from 0");
      }
      last_frames_.back() = std::max(last_frames_.back(), state.frame);
    }
    num_frames_ = std::max(num_frames_, last_frames_.back() + 1);
  }
}

bool SegmentRollout::Evaluate(const Eigen::VectorXd& parameters, double* residuals) {
  state_derivatives_are_current_ = false;
  rollout_ = Rollout();  // one at a time in memory
  rollout_ = simulator_.Run(parameters, num_frames_);
  if (!rollout_.status().ok()) {
    message_ = rollout_.status().Message();
    return false;
  }
  for (size_t i = 0; i < costs_.size(); ++i) {
    if (!costs_[i]->Evaluate(rollout_.trajectory(), residuals + first_rows_[i],
                             nullptr)) {
      message_ = "residual " + std::to_string(i) + " cannot be evaluated there";
      return false;
    }
  }
  message_.clear();
  return true;
}

bool SegmentRollout::CostOverHorizon(const Eigen::VectorXd& parameters, int num_frames,
                                     double* cost) {
  rollout_ = Rollout();  // one at a time in memory
  const Rollout rollout = simulator_.Run(parameters, std::min(num_frames, num_frames_));
  *cost = 0.0;
  if (!rollout.status().ok()) return false;
  Eigen::VectorXd residuals;
  for (size_t i = 0; i < costs_.size(); ++i) {
    if (last_frames_[i] >= num_frames) continue;
    residuals.resize(costs_[i]->num_residuals());
    if (!costs_[i]->Evaluate(rollout.trajectory(), residuals.data(), nullptr)) {
      return false;
    }
    *cost += 0.5 * residuals.squaredNorm();
  }
  return std::isfinite(*cost);
}

const std::vector<StateDerivative>& SegmentRollout::StateDerivatives() {
  if (state_derivatives_are_current_) return state_derivatives_;
  state_derivatives_.clear();
  Eigen::VectorXd unused;
  for (size_t i = 0; i < costs_.size(); ++i) {
    const size_t begin = state_derivatives_.size();
    unused.resize(costs_[i]->num_residuals());
    costs_[i]->Evaluate(rollout_.trajectory(), unused.data(), &state_derivatives_);
    for (size_t k = begin; k < state_derivatives_.size(); ++k) {
      state_derivatives_[k].first_row += first_rows_[i];
    }
  }
  state_derivatives_are_current_ = true;
  return state_derivatives_;
}

bool SegmentRollout::EvaluateJacobian(JacobianMethod method,
                                      const Eigen::VectorXd& dp_dq) {
  Sensitivity sensitivity(&simulator_, &rollout_);
  sensitivity.Jacobian(StateDerivatives(), num_residuals_, method, &jacobian_);
  bool is_finite = true;
  for (int row = 0; row < jacobian_.rows(); ++row) {
    jacobian_.row(row).array() *= dp_dq.transpose().array();
    is_finite &= jacobian_.row(row).allFinite();
  }
  if (sensitivity.ok() && is_finite) return true;
  message_ = DerivativeMessage(sensitivity);
  return false;
}

bool SegmentRollout::EvaluateGradient(const double* residuals,
                                      Eigen::VectorXd* gradient) {
  const size_t num_objects = rollout_.trajectory().positions.size();
  const Eigen::Map<const Eigen::VectorXd> all(residuals, num_residuals_);
  std::vector<Eigen::MatrixXd> dl_dx(num_objects);
  std::vector<Eigen::MatrixXd> dl_dv(num_objects);
  for (const StateDerivative& d : StateDerivatives()) {
    const auto add = [&](const SparseRows& derivative, Eigen::MatrixXd* sum) {
      if (derivative.rows() == 0) return;
      if (sum->size() == 0) sum->setZero(derivative.cols(), num_frames_);
      sum->col(d.frame) +=
          derivative.transpose() * all.segment(d.first_row, derivative.rows());
    };
    add(d.d_position, &dl_dx[d.object]);
    add(d.d_velocity, &dl_dv[d.object]);
  }
  Sensitivity sensitivity(&simulator_, &rollout_);
  *gradient = sensitivity.Gradient(dl_dx, dl_dv);
  if (sensitivity.ok()) return true;
  message_ = sensitivity.status().Message();
  return false;
}

JacobianMethod SegmentRollout::CheaperMethod() {
  return Sensitivity(&simulator_, &rollout_).CheaperMethod(StateDerivatives());
}

}  // namespace dpe
