// The residuals of a SegmentLink.
#ifndef DPE_ESTIMATION_LINK_COST_H_
#define DPE_ESTIMATION_LINK_COST_H_

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "dpe/engine/parameters.h"
#include "dpe/estimation/trajectory_cost.h"
#include "dpe/estimation/trajectory_segment.h"

namespace dpe {

// The part of a link that segment `from` knows: weight times state. What segment `to`
// subtracts is weight() times entries of its parameter vector, one per row.
class LinkCost : public TrajectoryCost {
 public:
  // @param to_layout  of the scene that segment link.to starts from
  // @throws SceneError if no initial state is estimated there
  static std::unique_ptr<LinkCost> Create(const SegmentLink& link,
                                          const ParameterLayout& to_layout);

  bool Evaluate(const Trajectory& trajectory, double* residuals,
                std::vector<StateDerivative>* derivatives) const override;

  // For each row the parameter of to_layout that it subtracts, and the row's weight.
  const std::vector<int>& parameters() const { return parameters_; }
  const Eigen::VectorXd& weights() const { return weights_; }
  void SetWeights(double position_weight, double velocity_weight);

 private:
  // The rows of one object's positions or velocities.
  struct Part {
    int object = 0;
    bool is_velocity = false;
    int first_row = 0;
    std::vector<int> coordinates;  // of 3N, one per row
    int num_coordinates = 0;       // 3N
  };

  LinkCost(int num_residuals, std::vector<StateReference> states, int frame,
           std::vector<Part> parts, std::vector<int> parameters);

  int frame_;
  std::vector<Part> parts_;
  std::vector<int> parameters_;
  Eigen::VectorXd weights_;
};

}  // namespace dpe

#endif  // DPE_ESTIMATION_LINK_COST_H_
