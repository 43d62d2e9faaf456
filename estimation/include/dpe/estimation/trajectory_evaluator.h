// Costs of one or several rollouts as a function of the optimiser's coordinates q.
//
//   q -> p = map(q) -> states = rollouts(p) -> r = costs(states)
//   dr/dq = dr/dstates * dstates/dp * dp/dq
//
// Priors on q (priors.h) add residuals that need no rollout; they count in cost(), its
// gradient and what the best point is, but have no rows in residuals() and jacobian().
//
// One rollout of every segment per new point, one derivative pass of each when
// derivatives are asked for, whatever the number of costs; the last point's results are
// kept. Segments (trajectory_segment.h) are worked on in parallel; the results are the
// same for any number of threads, bit by bit, unless JacobianMethod::kAuto decides
// differently for them.
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
#include "dpe/estimation/export.h"
#include "dpe/estimation/joint_layout.h"
#include "dpe/estimation/parameterization.h"
#include "dpe/estimation/priors.h"
#include "dpe/estimation/trajectory_cost.h"
#include "dpe/estimation/trajectory_segment.h"

namespace dpe {

struct TrajectoryEvaluatorOptions {
  JacobianMethod jacobian = JacobianMethod::kAuto;
  int num_threads = 1;
  // Of all segments together.
  std::size_t memory_limit_bytes = SimulatorOptions().memory_limit_bytes;
  Timings* timings = nullptr;  // both as in SimulatorOptions
  // Whether each segment has a wind of its own to be estimated, or all have the same.
  bool own_wind = false;
  // Polled once per step, by several threads; true makes the evaluation in progress
  // fail.
  std::function<bool()> interrupted;
  // Called after every evaluation whose cost is the least so far.
  std::function<void()> improved;
  // Of the joint parameters; residuals have to be in standard deviations of the noise.
  std::vector<Prior> priors;
  std::vector<SmoothnessPrior> smoothness;
};

class SegmentRollout;
class LinkCost;
class PriorRows;

class DPE_ESTIMATION_API TrajectoryEvaluator {
 public:
  // Simulates the estimated objects of `scene`, as many frames as the costs read.
  // @throws SceneError if the scene is not valid, the costs read a state that is not
  //         simulated, or a prior is not possible or of nothing that is estimated.
  TrajectoryEvaluator(const Scene& scene, TrajectoryCosts costs,
                      const TrajectoryEvaluatorOptions& options = {});

  // Several segments of the same cloths (see joint_layout.h), and what links them.
  // @throws SceneError as above, and if the cloths are not the same or a link does not
  //         fit the segments
  TrajectoryEvaluator(std::vector<TrajectorySegment> segments,
                      std::vector<SegmentLink> links = {},
                      const TrajectoryEvaluatorOptions& options = {});
  ~TrajectoryEvaluator();

  const TrajectoryEvaluatorOptions& options() const { return options_; }
  // Of the parameters of all segments.
  const JointLayout& joint_layout() const { return *joint_; }
  const ParameterLayout& layout() const { return joint_->layout(); }
  const ParameterMap& map() const { return map_; }
  int num_segments() const { return static_cast<int>(segments_.size()); }
  int num_parameters() const { return map_.size(); }
  int num_residuals() const { return static_cast<int>(residuals_.size()); }

  // The costs of all segments: those of the first, the links from it, those of the
  // second, and so on.
  const TrajectoryCosts& costs() const { return costs_; }
  int segment_of_cost(int cost) const { return segment_of_cost_[cost]; }
  // First row of a cost in residuals().
  int first_row(int cost) const { return first_rows_[cost]; }
  // First row of a segment's costs there, its jacobian()'s row 0.
  int first_row_of_segment(int segment) const { return segment_rows_[segment]; }

  Simulator* simulator(int segment = 0);
  int num_frames(int segment = 0) const;

  // Rolls out and evaluates the residuals, unless `coordinates` are those of the last
  // call. False if the rollout or a cost failed; message() says why.
  bool Evaluate(const Eigen::VectorXd& coordinates);

  // The cost over a shorter horizon: of those costs that read only frames below
  // `num_frames`, and the priors. False if the rollout or a cost failed. Not remembered
  // as a point.
  // Without links.
  bool CostOverHorizon(const Eigen::VectorXd& coordinates, int num_frames,
                       double* cost);

  // dr/dq at the last Evaluate()d point, which must have succeeded. False if a linear
  // system of the derivative pass could not be solved or the result is not finite.
  bool EvaluateJacobian();

  // d cost()/dq there, by one adjoint pass.
  bool EvaluateGradient(Eigen::VectorXd* gradient);

  // Results of the last successful calls.
  const Eigen::VectorXd& residuals() const { return residuals_; }
  // The rows of one segment; columns are those of its own layout: what other segments
  // alone have is zero. With one segment, dr/dq.
  const RowMajorMatrix& jacobian(int segment = 0) const;
  // dr/dq with all its zeros, num_residuals() x num_parameters().
  RowMajorMatrix DenseJacobian() const;
  // The squared lengths of its columns, without making it; links' targets left out.
  Eigen::VectorXd JacobianColumnSquares() const;
  double data_cost() const { return 0.5 * residuals_.squaredNorm(); }
  double prior_cost() const { return prior_cost_; }
  double cost() const { return data_cost() + prior_cost(); }
  const PriorRows& prior_rows() const { return *prior_rows_; }
  const Trajectory& trajectory(int segment = 0) const;
  bool ok() const { return ok_; }
  const std::string& message() const { return message_; }

  // The point of least cost() so far; empty before the first success.
  const Eigen::VectorXd& best_coordinates() const { return best_coordinates_; }
  double best_cost() const { return best_cost_; }

  int num_rollouts() const { return num_rollouts_; }
  int num_derivative_passes() const { return num_derivative_passes_; }
  // Sets the weights of a link; what was known of any point is forgotten, the best one
  // too.
  void SetLinkWeights(int link, double position_weight, double velocity_weight);
  int num_links() const { return static_cast<int>(links_.size()); }

  // One row of a link: the parameter that it subtracts `weight` times.
  struct LinkTerm {
    int parameter = 0;  // joint
    double weight = 0.0;
  };
  // Those of a cost's rows; empty if the cost is not a link's.
  std::vector<LinkTerm> LinkTerms(int cost) const;
  // The segment that the cost's link leads to; -1 if it is not a link's.
  int LinkTarget(int cost) const;

  // "tangent" or "adjoint": what EvaluateJacobian uses for the first segment's costs.
  std::string JacobianMethodName();

 private:
  struct Link {
    int cost = 0;  // index into costs_
    int to = 0;
    LinkCost* state = nullptr;    // costs_[cost]
    std::vector<int> parameters;  // joint, one per row
  };

  void MakeSegments(std::vector<TrajectorySegment> segments,
                    const std::vector<SegmentLink>& links);
  void SubtractLinkTargets(const Eigen::VectorXd& parameters);
  const Link* FindLink(int cost) const;
  bool AllOk(const std::vector<char>& ok);
  bool Fail(const std::string& message);
  void Forget();

  TrajectoryEvaluatorOptions options_;
  TrajectoryCosts costs_;
  std::vector<int> segment_of_cost_, first_rows_, segment_rows_;
  std::vector<std::unique_ptr<SegmentRollout>> segments_;
  std::vector<Link> links_;
  std::unique_ptr<JointLayout> joint_;
  ParameterMap map_;
  std::unique_ptr<PriorRows> prior_rows_;

  Eigen::VectorXd coordinates_;  // of the last evaluation
  bool ok_ = false;
  std::string message_ = "nothing was evaluated yet";
  Eigen::VectorXd residuals_;
  double prior_cost_ = 0.0;
  bool jacobian_is_current_ = false;

  Eigen::VectorXd best_coordinates_;
  double best_cost_;
  int num_rollouts_ = 0;
  int num_derivative_passes_ = 0;
};

}  // namespace dpe

#endif  // DPE_ESTIMATION_TRAJECTORY_EVALUATOR_H_
