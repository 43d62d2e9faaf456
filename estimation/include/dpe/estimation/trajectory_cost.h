// What a fit minimises: residuals on the states that a rollout passes through.
//
//   cost(p) = 1/2 sum_i |r_i(states(p))|^2
//
// A TrajectoryCost is one r_i with its derivative with respect to the states it reads;
// the chain rule through the rollout, the parameters and Ceres are TrajectoryProblem's
// business. A new kind of residual is one subclass.
#ifndef DPE_ESTIMATION_TRAJECTORY_COST_H_
#define DPE_ESTIMATION_TRAJECTORY_COST_H_

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "dpe/engine/scene.h"
#include "dpe/engine/sensitivity.h"
#include "dpe/engine/trajectory.h"
#include "dpe/estimation/export.h"
#include "dpe/estimation/observations.h"
#include "dpe/estimation/robust_loss.h"

namespace dpe {

class DPE_ESTIMATION_API TrajectoryCost {
 public:
  // One object's state at one frame.
  struct StateReference {
    int object = 0;
    int frame = 0;
  };

  virtual ~TrajectoryCost() = default;

  int num_residuals() const { return num_residuals_; }

  // The states that the residual reads; it may read no others.
  const std::vector<StateReference>& states() const { return states_; }

  // Evaluates the residual on a trajectory that has reached all of states().
  //
  // @param trajectory   simulated states
  // @param residuals    num_residuals() values to write
  // @param derivatives  if not null, receives (appended) the derivative with respect to
  //                     the states; rows are local to this cost (0 is its first), and
  //                     several entries for the same rows add up
  // @return             false if the residual cannot be evaluated there: the optimiser
  //                     then rejects the step
  virtual bool Evaluate(const Trajectory& trajectory, double* residuals,
                        std::vector<StateDerivative>* derivatives) const = 0;

 protected:
  TrajectoryCost(int num_residuals, std::vector<StateReference> states)
      : num_residuals_(num_residuals), states_(std::move(states)) {}

 private:
  int num_residuals_;
  std::vector<StateReference> states_;
};

using TrajectoryCosts = std::vector<std::unique_ptr<TrajectoryCost>>;

struct PositionCostOptions {
  LossType loss = LossType::kNone;
  // Of the loss, in standard deviations of a coordinate's noise (in m where that is not
  // known); 0: RobustLoss::DefaultScale.
  double loss_scale = 0.0;
};

// Simulated minus observed position, three rows per observation, divided by the noise's
// standard deviation where that is known (in m otherwise), as the loss makes them. Only
// what the estimated objects' free vertices move counts.
//
// A residual is linear in the states that it reads (a selection of vertices, a
// barycentric combination, an interpolation in time) until the loss bends it.
class DPE_ESTIMATION_API PositionCost : public TrajectoryCost {
 public:
  // The vertices observed at one frame, by object, then vertex. Null if there are none.
  static std::unique_ptr<PositionCost> Create(const Scene& scene,
                                              const Observations& observations,
                                              int frame,
                                              const PositionCostOptions& options = {});

  bool Evaluate(const Trajectory& trajectory, double* residuals,
                std::vector<StateDerivative>* derivatives) const override;

 private:
  PositionCost(Eigen::VectorXd target, std::vector<StateDerivative> terms,
               const RobustLoss& loss);

  // Of these samples of markers, interpolated within the first `num_frames` frames.
  // Null if there are none.
  static std::unique_ptr<PositionCost> CreateFromSamples(
      const Scene& scene, const Observations& observations,
      const std::vector<const MarkerSample*>& samples, int num_frames,
      const PositionCostOptions& options);

  friend std::vector<std::unique_ptr<TrajectoryCost>> MakePositionCosts(
      const Scene& scene, const Observations& observations, int num_frames,
      const PositionCostOptions& options);

  Eigen::VectorXd target_;              // in standard deviations (or m)
  std::vector<StateDerivative> terms_;  // residual = sum of d_position x - target
  RobustLoss loss_;
};

// The costs of all frames from 1 to num_frames - 1 in which anything was observed
// (frame 0 is the given initial state: no parameter moves it).
//
// @throws SceneError if the noise is known of some observations and not of others,
//         whose residuals could not be compared
DPE_ESTIMATION_API TrajectoryCosts
MakePositionCosts(const Scene& scene, const Observations& observations, int num_frames,
                  const PositionCostOptions& options = {});

}  // namespace dpe

#endif  // DPE_ESTIMATION_TRAJECTORY_COST_H_
