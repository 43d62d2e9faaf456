#include <utility>

#include "dpe/engine/parameters.h"
#include "dpe/estimation/trajectory_cost.h"

namespace dpe {
namespace {

std::vector<int> ObservedFreeVertices(const Scene& scene,
                                      const Observations& observations, int object,
                                      int frame) {
  std::vector<int> vertices;
  const ClothObject& cloth = scene.objects[object];
  for (int v = 0; v < cloth.num_vertices(); ++v) {
    if (!cloth.is_fixed[v] && observations.IsObserved(object, v, frame)) {
      vertices.push_back(v);
    }
  }
  return vertices;
}

// The matrix that picks the coordinates of `vertices` out of 3 * num_vertices.
SparseRows SelectionMatrix(const std::vector<int>& vertices, int num_vertices) {
  SparseRows selection(3 * vertices.size(), 3 * num_vertices);
  selection.reserve(Eigen::VectorXi::Constant(3 * vertices.size(), 1));
  for (size_t i = 0; i < vertices.size(); ++i) {
    for (int c = 0; c < 3; ++c) selection.insert(3 * i + c, 3 * vertices[i] + c) = 1.0;
  }
  selection.makeCompressed();
  return selection;
}

}  // namespace

PositionCost::PositionCost(int num_residuals, std::vector<StateReference> states,
                           std::vector<Part> parts)
    : TrajectoryCost(num_residuals, std::move(states)), parts_(std::move(parts)) {}

std::unique_ptr<PositionCost> PositionCost::Create(const Scene& scene,
                                                   const Observations& observations,
                                                   int frame) {
  std::vector<StateReference> states;
  std::vector<Part> parts;
  int num_rows = 0;
  for (int object = 0; object < static_cast<int>(scene.objects.size()); ++object) {
    if (!ParameterLayout::ObjectIsEstimated(scene, object)) continue;
    Part part;
    part.vertices = ObservedFreeVertices(scene, observations, object, frame);
    if (part.vertices.empty()) continue;
    const int rows = 3 * static_cast<int>(part.vertices.size());
    part.target.resize(rows);
    for (size_t i = 0; i < part.vertices.size(); ++i) {
      part.target.segment<3>(3 * i) =
          observations.positions[object].col(frame).segment<3>(3 * part.vertices[i]);
    }
    part.derivative.frame = frame;
    part.derivative.object = object;
    part.derivative.first_row = num_rows;
    part.derivative.d_position =
        SelectionMatrix(part.vertices, scene.objects[object].num_vertices());
    num_rows += rows;
    states.push_back({object, frame});
    parts.push_back(std::move(part));
  }
  if (parts.empty()) return nullptr;
  return std::unique_ptr<PositionCost>(
      new PositionCost(num_rows, std::move(states), std::move(parts)));
}

bool PositionCost::Evaluate(const Trajectory& trajectory, double* residuals,
                            std::vector<StateDerivative>* derivatives) const {
  for (const Part& part : parts_) {
    const StateDerivative& derivative = part.derivative;
    const auto simulated =
        trajectory.positions[derivative.object].col(derivative.frame);
    for (size_t i = 0; i < part.vertices.size(); ++i) {
      Eigen::Map<Eigen::Vector3d>(residuals + derivative.first_row + 3 * i) =
          simulated.segment<3>(3 * part.vertices[i]) - part.target.segment<3>(3 * i);
    }
    if (derivatives != nullptr) derivatives->push_back(derivative);
  }
  return true;
}

TrajectoryCosts MakePositionCosts(const Scene& scene, const Observations& observations,
                                  int num_frames) {
  TrajectoryCosts costs;
  for (int frame = 1; frame < num_frames; ++frame) {
    std::unique_ptr<PositionCost> cost =
        PositionCost::Create(scene, observations, frame);
    if (cost != nullptr) costs.push_back(std::move(cost));
  }
  return costs;
}

}  // namespace dpe
