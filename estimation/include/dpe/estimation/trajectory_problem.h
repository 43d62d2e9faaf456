// Trajectory costs as Ceres sees them.
//
// Every TrajectoryCost is one ceres::CostFunction over those parameter blocks that its
// segment's motion depends on (one ceres block per ParameterBlock of the joint layout,
// in the coordinates of ParameterMap), a link's also over the initial state that it
// leads to. One ceres::EvaluationCallback runs the rollouts, and the derivative passes
// when Jacobians are asked for; the cost functions only copy from it. A rollout that
// fails makes them return false, which Ceres takes as a rejected step. So does a trial
// step that changes a positive parameter by more than a factor of kMaxFactor: a linear
// model in the logarithm says nothing that far away, and what lies there is mostly
// flat, so that an optimiser would not find back.
#ifndef DPE_ESTIMATION_TRAJECTORY_PROBLEM_H_
#define DPE_ESTIMATION_TRAJECTORY_PROBLEM_H_

#include <ceres/ceres.h>

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "dpe/estimation/export.h"
#include "dpe/estimation/trajectory_evaluator.h"

namespace dpe {

class DPE_ESTIMATION_API TrajectoryProblem : private ceres::EvaluationCallback {
 public:
  // The largest change of a positive parameter in one least-squares step.
  static constexpr double kMaxFactor = 100.0;

  // As the constructors of TrajectoryEvaluator.
  TrajectoryProblem(const Scene& scene, TrajectoryCosts costs,
                    const TrajectoryEvaluatorOptions& options = {});
  TrajectoryProblem(std::vector<TrajectorySegment> segments,
                    std::vector<SegmentLink> links = {},
                    const TrajectoryEvaluatorOptions& options = {});
  TrajectoryProblem(const TrajectoryProblem&) = delete;
  TrajectoryProblem& operator=(const TrajectoryProblem&) = delete;

  TrajectoryEvaluator* evaluator() { return &evaluator_; }
  const ParameterLayout& layout() const { return evaluator_.layout(); }

  // Where Ceres keeps the coordinates: layout order, parameter block b at
  // block_coordinates(b). Set a start here before solving; read the solution here
  // after.
  const Eigen::VectorXd& coordinates() const { return coordinates_; }
  void set_coordinates(const Eigen::VectorXd& coordinates);
  double* block_coordinates(int block);

  // The least-squares problem; the priors of the evaluator's options are in it. Further
  // residual blocks may be added over block_coordinates(), of which the evaluator's
  // cost and best point and NewFirstOrderFunction() know nothing. Do not use Ceres's
  // check_gradients with it: that clones the problem without its callback.
  ceres::Problem* least_squares() { return &least_squares_; }

  // The same problem, with further residual blocks as they stand at the call, losses,
  // bounds and manifolds, rotated into one residual more than it has parameters (or,
  // where residuals of several segments depend on different blocks, than these have):
  // cost, gradient and J^T J are the same and an optimiser takes the same steps, but
  // one that factorises J for every step, as DENSE_QR does, takes far less time and
  // memory. Null if there are no more residuals than parameters. Must not outlive this;
  // a residual by itself means nothing.
  std::unique_ptr<ceres::Problem> NewReducedLeastSquares();

  // The same cost as one scalar function of all coordinates with its adjoint gradient;
  // the caller (or a ceres::GradientProblem) owns it, and it must not outlive this.
  ceres::FirstOrderFunction* NewFirstOrderFunction();

 private:
  void AddCosts();
  void PrepareForEvaluation(bool evaluate_jacobians, bool new_point) override;
  ceres::Problem::Options ProblemOptions();
  bool StepIsTooLong() const;

  TrajectoryEvaluator evaluator_;
  Eigen::VectorXd coordinates_;
  ceres::Problem least_squares_;
  // The point of the last Jacobian, which trial steps start from; empty: none yet.
  Eigen::VectorXd step_origin_;
  bool point_ok_ = false;
  bool jacobian_ok_ = false;

  friend class CachedCostFunction;
};

}  // namespace dpe

#endif  // DPE_ESTIMATION_TRAJECTORY_PROBLEM_H_
