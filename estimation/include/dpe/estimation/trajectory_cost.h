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
#include "dpe/estimation/observations.h"

namespace dpe {

class TrajectoryCost {
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

// Simulated minus observed position, m, of every observed free vertex of the estimated
// objects at one frame: three rows per vertex, by object, then vertex.
class PositionCost : public TrajectoryCost {
 public:
  // Null if no such vertex is observed at `frame`.
  static std::unique_ptr<PositionCost> Create(const Scene& scene,
                                              const Observations& observations,
                                              int frame);

  bool Evaluate(const Trajectory& trajectory, double* residuals,
                std::vector<StateDerivative>* derivatives) const override;

 private:
  // The observed vertices of one object.
  struct Part {
    std::vector<int> vertices;
    Eigen::VectorXd target;      // 3 per vertex, m
    StateDerivative derivative;  // constant: selects the coordinates
  };

  PositionCost(int num_residuals, std::vector<StateReference> states,
               std::vector<Part> parts);

  std::vector<Part> parts_;
};

// One PositionCost per frame from 1 to num_frames - 1 in which anything was observed
// (frame 0 is the given initial state: no parameter moves it).
TrajectoryCosts MakePositionCosts(const Scene& scene, const Observations& observations,
                                  int num_frames);

}  // namespace dpe

#endif  // DPE_ESTIMATION_TRAJECTORY_COST_H_
