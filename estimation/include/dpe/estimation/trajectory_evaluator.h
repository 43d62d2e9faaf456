// Costs of a rollout as a function of the optimiser's coordinates q.
//
//   q -> p = map(q) -> states = rollout(p) -> r = costs(states)
//   dr/dq = dr/dstates * dstates/dp * dp/dq
//
// One rollout per new point, one derivative pass when derivatives are asked for,
// whatever the number of costs; the last point's results are kept.
#ifndef DPE_ESTIMATION_TRAJECTORY_EVALUATOR_H_
#define DPE_ESTIMATION_TRAJECTORY_EVALUATOR_H_

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "dpe/engine/scene.h"
#include "dpe/engine/sensitivity.h"
#include "dpe/engine/simulator.h"
#include "dpe/estimation/parameterization.h"
#include "dpe/estimation/trajectory_cost.h"

namespace dpe {

struct TrajectoryEvaluatorOptions {
  JacobianMethod jacobian = JacobianMethod::kAuto;
  int num_threads = 1;
  std::size_t memory_limit_bytes = SimulatorOptions().memory_limit_bytes;
  Timings* timings = nullptr;  // both as in SimulatorOptions
  // Polled once per step; true makes the evaluation in progress fail.
  std::function<bool()> interrupted;
  // Called after every evaluation whose cost is the least so far.
  std::function<void()> improved;
};

class TrajectoryEvaluator {
 public:
  // Simulates the estimated objects of `scene`, as many frames as the costs read.
  // @throws SceneError if the scene is not valid or the costs read a state that is not
  //         simulated.
  TrajectoryEvaluator(const Scene& scene, TrajectoryCosts costs,
                      const TrajectoryEvaluatorOptions& options = {});

  const TrajectoryEvaluatorOptions& options() const { return options_; }
  const ParameterLayout& layout() const { return simulator_.layout(); }
  const ParameterMap& map() const { return map_; }
  const TrajectoryCosts& costs() const { return costs_; }
  Simulator* simulator() { return &simulator_; }
  int num_parameters() const { return map_.size(); }
  int num_residuals() const { return static_cast<int>(residuals_.size()); }
  int num_frames() const { return num_frames_; }
  // First row of a cost in residuals() and jacobian().
  int first_row(int cost) const { return first_rows_[cost]; }

  // Rolls out and evaluates the residuals, unless `coordinates` are those of the last
  // call. False if the rollout or a cost failed; message() says why.
  bool Evaluate(const Eigen::VectorXd& coordinates);

  // The cost over a shorter horizon: of those costs that read only frames below
  // `num_frames`. False if the rollout or a cost failed. Not remembered as a point.
  bool CostOverHorizon(const Eigen::VectorXd& coordinates, int num_frames,
                       double* cost);

  // dr/dq at the last Evaluate()d point, which must have succeeded. False if a linear
  // system of the derivative pass could not be solved or the result is not finite.
  bool EvaluateJacobian();

  // d(1/2 |r|^2)/dq there, by one adjoint pass.
  bool EvaluateGradient(Eigen::VectorXd* gradient);

  // Results of the last successful calls.
  const Eigen::VectorXd& residuals() const { return residuals_; }
  const RowMajorMatrix& jacobian() const { return jacobian_; }
  double cost() const { return 0.5 * residuals_.squaredNorm(); }
  const Trajectory& trajectory() const { return rollout_.trajectory(); }
  bool ok() const { return ok_; }
  const std::string& message() const { return message_; }

  // The point of least cost so far; empty before the first success.
  const Eigen::VectorXd& best_coordinates() const { return best_coordinates_; }
  double best_cost() const { return best_cost_; }

  int num_rollouts() const { return num_rollouts_; }
  int num_derivative_passes() const { return num_derivative_passes_; }
  // "tangent" or "adjoint": what EvaluateJacobian uses for these costs.
  std::string JacobianMethodName();

 private:
  bool EvaluateCosts();
  bool Fail(const std::string& message);
  const std::vector<StateDerivative>& StateDerivatives();

  TrajectoryEvaluatorOptions options_;
  Simulator simulator_;
  ParameterMap map_;
  TrajectoryCosts costs_;
  std::vector<int> first_rows_;
  std::vector<int> last_frames_;  // the last frame that each cost reads
  int num_frames_ = 1;

  Eigen::VectorXd coordinates_;  // of the last evaluation
  bool ok_ = false;
  std::string message_ = "nothing was evaluated yet";
  Rollout rollout_;
  Eigen::VectorXd residuals_;
  RowMajorMatrix jacobian_;
  bool jacobian_is_current_ = false;
  std::vector<StateDerivative> state_derivatives_;
  bool state_derivatives_are_current_ = false;

  Eigen::VectorXd best_coordinates_;
  double best_cost_;
  int num_rollouts_ = 0;
  int num_derivative_passes_ = 0;
};

}  // namespace dpe

#endif  // DPE_ESTIMATION_TRAJECTORY_EVALUATOR_H_
