// One segment of a fit: its simulator, its costs, and both at one point.
#ifndef DPE_ESTIMATION_SEGMENT_ROLLOUT_H_
#define DPE_ESTIMATION_SEGMENT_ROLLOUT_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "dpe/engine/sensitivity.h"
#include "dpe/engine/simulator.h"
#include "dpe/estimation/trajectory_cost.h"

namespace dpe {

// Parameters are those of its simulator's layout, SI units.
class SegmentRollout {
 public:
  // @param costs    must outlive this
  // @throws SceneError if the scene is not valid or the costs read a state that is not
  //         simulated
  SegmentRollout(const Scene& scene, std::vector<const TrajectoryCost*> costs,
                 const SimulatorOptions& options);

  Simulator* simulator() { return &simulator_; }
  const Simulator& simulator() const { return simulator_; }
  int num_residuals() const { return num_residuals_; }
  int num_frames() const { return num_frames_; }
  // First row of its cost `cost`.
  int first_row(int cost) const { return first_rows_[cost]; }
  const Rollout& rollout() const { return rollout_; }
  bool was_interrupted() const {
    return rollout_.status().code == RolloutStatus::Code::kInterrupted;
  }
  const std::string& message() const { return message_; }

  // Rolls out and writes the costs' residuals. False: message() says why.
  bool Evaluate(const Eigen::VectorXd& parameters, double* residuals);

  // The sum of the costs that read only frames below `num_frames`. Forgets the point.
  bool CostOverHorizon(const Eigen::VectorXd& parameters, int num_frames, double* cost);

  // dr/dq at the point of the last Evaluate, dp/dq given.
  bool EvaluateJacobian(JacobianMethod method, const Eigen::VectorXd& dp_dq);
  const RowMajorMatrix& jacobian() const { return jacobian_; }

  // (dr/dp)^T residuals there.
  bool EvaluateGradient(const double* residuals, Eigen::VectorXd* gradient);

  JacobianMethod CheaperMethod();

  // To be called when costs have changed.
  void Forget() { state_derivatives_are_current_ = false; }

 private:
  const std::vector<StateDerivative>& StateDerivatives();

  Simulator simulator_;
  std::vector<const TrajectoryCost*> costs_;
  std::vector<int> first_rows_;
  std::vector<int> last_frames_;  // the last frame that each cost reads
  int num_frames_ = 1;
  int num_residuals_ = 0;

  Rollout rollout_;
  std::string message_;
  std::vector<StateDerivative> state_derivatives_;
  bool state_derivatives_are_current_ = false;
  RowMajorMatrix jacobian_;
};

}  // namespace dpe

#endif  // DPE_ESTIMATION_SEGMENT_ROLLOUT_H_
