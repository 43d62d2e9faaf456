#include "dpe/estimation/trajectory_evaluator.h"

#include <cmath>
#include <limits>
#include <utility>

namespace dpe {
namespace {

SimulatorOptions MakeSimulatorOptions(const TrajectoryEvaluatorOptions& options) {
  SimulatorOptions simulator_options;
  simulator_options.only_estimated_objects = true;
  simulator_options.num_threads = options.num_threads;
  simulator_options.memory_limit_bytes = options.memory_limit_bytes;
  simulator_options.interrupted = options.interrupted;
  simulator_options.timings = options.timings;
  return simulator_options;
}

}  // namespace

TrajectoryEvaluator::TrajectoryEvaluator(const Scene& scene, TrajectoryCosts costs,
                                         const TrajectoryEvaluatorOptions& options)
    : options_(options),
      simulator_(scene, MakeSimulatorOptions(options)),
      map_(simulator_.layout()),
      costs_(std::move(costs)),
      best_cost_(std::numeric_limits<double>::infinity()) {
  int num_rows = 0;
  for (const auto& cost : costs_) {
    first_rows_.push_back(num_rows);
    num_rows += cost->num_residuals();
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
  residuals_.resize(num_rows);
}

bool TrajectoryEvaluator::Fail(const std::string& message) {
  ok_ = false;
  message_ = message;
  return false;
}

bool TrajectoryEvaluator::Evaluate(const Eigen::VectorXd& coordinates) {
  if (coordinates_.size() == coordinates.size() && coordinates_ == coordinates) {
    return ok_;
  }
  jacobian_is_current_ = false;
  state_derivatives_are_current_ = false;
  coordinates_ = coordinates;
  const Eigen::VectorXd parameters = map_.ToParameters(coordinates);
  if (!parameters.allFinite()) return Fail("a parameter is not a finite number");
  rollout_ = Rollout();  // one at a time in memory
  rollout_ = simulator_.Run(parameters, num_frames_);
  ++num_rollouts_;
  if (!rollout_.status().ok()) {
    // An interrupted rollout says nothing about this point: do not remember it.
    if (rollout_.status().code == RolloutStatus::Code::kInterrupted) {
      coordinates_.resize(0);
    }
    return Fail(rollout_.status().Message());
  }
  return EvaluateCosts();
}

bool TrajectoryEvaluator::EvaluateCosts() {
  for (size_t i = 0; i < costs_.size(); ++i) {
    if (!costs_[i]->Evaluate(trajectory(), residuals_.data() + first_rows_[i],
                             nullptr)) {
      return Fail("residual " + std::to_string(i) + " cannot be evaluated there");
    }
  }
  if (!std::isfinite(cost())) return Fail("the cost is not a finite number");
  ok_ = true;
  message_.clear();
  if (cost() < best_cost_) {
    best_cost_ = cost();
    best_coordinates_ = coordinates_;
    if (options_.improved) options_.improved();
  }
  return true;
}

bool TrajectoryEvaluator::CostOverHorizon(const Eigen::VectorXd& coordinates,
                                          int num_frames, double* cost) {
  const Eigen::VectorXd parameters = map_.ToParameters(coordinates);
  if (!parameters.allFinite()) return false;
  rollout_ = Rollout();  // one at a time in memory
  coordinates_.resize(0);
  ok_ = false;
  const Rollout rollout = simulator_.Run(parameters, num_frames);
  ++num_rollouts_;
  if (!rollout.status().ok()) return false;
  Eigen::VectorXd residuals;
  *cost = 0.0;
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

const std::vector<StateDerivative>& TrajectoryEvaluator::StateDerivatives() {
  if (state_derivatives_are_current_) return state_derivatives_;
  state_derivatives_.clear();
  Eigen::VectorXd unused;
  for (size_t i = 0; i < costs_.size(); ++i) {
    const size_t begin = state_derivatives_.size();
    unused.resize(costs_[i]->num_residuals());
    costs_[i]->Evaluate(trajectory(), unused.data(), &state_derivatives_);
    for (size_t k = begin; k < state_derivatives_.size(); ++k) {
      state_derivatives_[k].first_row += first_rows_[i];
    }
  }
  state_derivatives_are_current_ = true;
  return state_derivatives_;
}

bool TrajectoryEvaluator::EvaluateJacobian() {
  if (!ok_) return false;
  if (jacobian_is_current_) return true;
  Sensitivity sensitivity(&simulator_, &rollout_);
  sensitivity.Jacobian(StateDerivatives(), num_residuals(), options_.jacobian,
                       &jacobian_);
  ++num_derivative_passes_;
  const Eigen::VectorXd scale = map_.Derivative(coordinates_);
  bool is_finite = true;
  for (int row = 0; row < jacobian_.rows(); ++row) {
    jacobian_.row(row).array() *= scale.transpose().array();
    is_finite &= jacobian_.row(row).allFinite();
  }
  if (!sensitivity.ok() || !is_finite) {
    message_ = "the derivative of the rollout could not be computed";
    return false;
  }
  jacobian_is_current_ = true;
  return true;
}

bool TrajectoryEvaluator::EvaluateGradient(Eigen::VectorXd* gradient) {
  if (!ok_) return false;
  const size_t num_objects = trajectory().positions.size();
  std::vector<Eigen::MatrixXd> dl_dx(num_objects);
  std::vector<Eigen::MatrixXd> dl_dv(num_objects);
  for (const StateDerivative& d : StateDerivatives()) {
    const auto add = [&](const SparseRows& derivative, Eigen::MatrixXd* sum) {
      if (derivative.rows() == 0) return;
      if (sum->size() == 0) sum->setZero(derivative.cols(), num_frames_);
      sum->col(d.frame) +=
          derivative.transpose() * residuals_.segment(d.first_row, derivative.rows());
    };
    add(d.d_position, &dl_dx[d.object]);
    add(d.d_velocity, &dl_dv[d.object]);
  }
  Sensitivity sensitivity(&simulator_, &rollout_);
  *gradient = sensitivity.Gradient(dl_dx, dl_dv);
  ++num_derivative_passes_;
  gradient->array() *= map_.Derivative(coordinates_).array();
  if (!sensitivity.ok() || !gradient->allFinite()) {
    message_ = "the gradient of the rollout could not be computed";
    return false;
  }
  return true;
}

std::string TrajectoryEvaluator::JacobianMethodName() {
  JacobianMethod method = options_.jacobian;
  if (method == JacobianMethod::kAuto && ok_) {
    method = Sensitivity(&simulator_, &rollout_).CheaperMethod(StateDerivatives());
  }
  return method == JacobianMethod::kAdjoint ? "adjoint" : "tangent";
}

}  // namespace dpe
