#include "link_cost.h"

#include <utility>

namespace dpe {

std::unique_ptr<LinkCost> LinkCost::Create(const SegmentLink& link,
                                           const ParameterLayout& to_layout) {
  std::vector<StateReference> states;
  std::vector<Part> parts;
  std::vector<int> parameters;
  for (const ParameterBlock& block : to_layout.blocks()) {
    Part part;
    part.is_velocity = block.kind == ParameterKind::kInitialVelocity;
    if (!part.is_velocity && block.kind != ParameterKind::kInitialPosition) continue;
    part.object = block.object;
    part.first_row = static_cast<int>(parameters.size());
    part.num_coordinates = static_cast<int>(block.element_to_local.size());
    for (int c = 0; c < part.num_coordinates; ++c) {
      if (block.element_to_local[c] < 0) continue;
      part.coordinates.push_back(c);
      parameters.push_back(block.offset + block.element_to_local[c]);
    }
    if (states.empty() || states.back().object != block.object) {
      states.push_back({block.object, link.frame});
    }
    parts.push_back(std::move(part));
  }
  if (parts.empty()) {
    throw SceneError("segment " + std::to_string(link.to) +
                     " is to begin where segment " + std::to_string(link.from) +
                     " has got to, but estimates no initial position or velocity");
  }
  const int num_rows = static_cast<int>(parameters.size());
  auto cost =
      std::unique_ptr<LinkCost>(new LinkCost(num_rows, std::move(states), link.frame,
                                             std::move(parts), std::move(parameters)));
  cost->SetWeights(link.position_weight, link.velocity_weight);
  return cost;
}

LinkCost::LinkCost(int num_residuals, std::vector<StateReference> states, int frame,
                   std::vector<Part> parts, std::vector<int> parameters)
    : TrajectoryCost(num_residuals, std::move(states)),
      frame_(frame),
      parts_(std::move(parts)),
      parameters_(std::move(parameters)) {}

void LinkCost::SetWeights(double position_weight, double velocity_weight) {
  weights_.resize(num_residuals());
  for (const Part& part : parts_) {
    weights_.segment(part.first_row, part.coordinates.size())
        .setConstant(part.is_velocity ? velocity_weight : position_weight);
  }
}

bool LinkCost::Evaluate(const Trajectory& trajectory, double* residuals,
                        std::vector<StateDerivative>* derivatives) const {
  for (const Part& part : parts_) {
    const auto& states =
        part.is_velocity ? trajectory.velocities : trajectory.positions;
    const int count = static_cast<int>(part.coordinates.size());
    for (int k = 0; k < count; ++k) {
      residuals[part.first_row + k] = weights_[part.first_row + k] *
                                      states[part.object](part.coordinates[k], frame_);
    }
    if (derivatives == nullptr) continue;
    SparseRows selection(count, part.num_coordinates);
    selection.reserve(Eigen::VectorXi::Constant(count, 1));
    for (int k = 0; k < count; ++k) {
      selection.insert(k, part.coordinates[k]) = weights_[part.first_row + k];
    }
    selection.makeCompressed();
    StateDerivative d;
    d.frame = frame_;
    d.object = part.object;
    d.first_row = part.first_row;
    d.d_position.resize(count, part.num_coordinates);
    (part.is_velocity ? d.d_velocity : d.d_position) = std::move(selection);
    derivatives->push_back(std::move(d));
  }
  return true;
}

}  // namespace dpe
