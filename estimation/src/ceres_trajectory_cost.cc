#include "dpe/estimation/ceres_trajectory_cost.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

namespace dpe {
namespace {

using Quantity = StateRead::Quantity;

[[noreturn]] void ThrowAtRead(int read, const std::string& problem) {
  throw SceneError("custom residual: read " + std::to_string(read) + " " + problem);
}

void CheckRead(const Scene& scene, const StateRead& read, int index) {
  const int num_objects = static_cast<int>(scene.objects.size());
  if (read.object < 0 || read.object >= num_objects) {
    ThrowAtRead(index, "names object " + std::to_string(read.object) +
                           "; accepted are 0 to " + std::to_string(num_objects - 1));
  }
  if (read.frame < 0) {
    ThrowAtRead(index, "names frame " + std::to_string(read.frame) +
                           "; accepted are frames from 0");
  }
  if (read.vertices.empty()) ThrowAtRead(index, "names no vertices");
  const int num_vertices = scene.objects[read.object].num_vertices();
  for (const int vertex : read.vertices) {
    if (vertex < 0 || vertex >= num_vertices) {
      ThrowAtRead(index, "names vertex " + std::to_string(vertex) + " of object " +
                             std::to_string(read.object) + "; accepted are 0 to " +
                             std::to_string(num_vertices - 1));
    }
  }
}

void CheckSizes(const ceres::CostFunction& function,
                const std::vector<StateRead>& reads) {
  const std::vector<int32_t>& sizes = function.parameter_block_sizes();
  if (function.num_residuals() <= 0) {
    throw SceneError("custom residual: it has " +
                     std::to_string(function.num_residuals()) +
                     " residuals; accepted are 1 and more");
  }
  if (sizes.size() != reads.size()) {
    throw SceneError("custom residual: it takes " + std::to_string(sizes.size()) +
                     " arrays of states, but " + std::to_string(reads.size()) +
                     " reads were given");
  }
  for (size_t i = 0; i < reads.size(); ++i) {
    const size_t size = 3 * reads[i].vertices.size();
    if (static_cast<size_t>(sizes[i]) != size) {
      ThrowAtRead(static_cast<int>(i),
                  "has " + std::to_string(reads[i].vertices.size()) +
                      " vertices and gives " + std::to_string(size) +
                      " numbers, but the residual takes " + std::to_string(sizes[i]) +
                      " there");
    }
  }
}

// Every (object, frame) that is read, once.
std::vector<TrajectoryCost::StateReference> StatesOf(
    const std::vector<StateRead>& reads) {
  std::vector<TrajectoryCost::StateReference> states;
  for (const StateRead& read : reads) {
    const bool is_known =
        std::any_of(states.begin(), states.end(), [&](const auto& state) {
          return state.object == read.object && state.frame == read.frame;
        });
    if (!is_known) states.push_back({read.object, read.frame});
  }
  return states;
}

Eigen::VectorXd Gather(const Trajectory& trajectory, const StateRead& read) {
  const auto& states = read.quantity == Quantity::kPosition ? trajectory.positions
                                                            : trajectory.velocities;
  const auto state = states[read.object].col(read.frame);
  Eigen::VectorXd values(3 * read.vertices.size());
  for (size_t i = 0; i < read.vertices.size(); ++i) {
    values.segment<3>(3 * i) = state.segment<3>(3 * read.vertices[i]);
  }
  return values;
}

// Adds the nonzero columns of a read's Jacobian where they belong in a state's.
void Scatter(const RowMajorMatrix& jacobian, const std::vector<int>& vertices,
             std::vector<Eigen::Triplet<double>>* triplets) {
  for (int row = 0; row < jacobian.rows(); ++row) {
    for (int column = 0; column < jacobian.cols(); ++column) {
      // NaN is not zero, and must not get lost.
      if (jacobian(row, column) == 0.0) continue;
      triplets->emplace_back(row, 3 * vertices[column / 3] + column % 3,
                             jacobian(row, column));
    }
  }
}

}  // namespace

void CeresTrajectoryCost::CheckEigenAlignment(int alignment) {
  if (alignment == EIGEN_MAX_ALIGN_BYTES) return;
  throw SceneError("custom residual: compiled for Eigen objects aligned to " +
                   std::to_string(alignment) + " bytes, but dpe and Ceres Solver for " +
                   std::to_string(EIGEN_MAX_ALIGN_BYTES) +
                   "; compile it without -march=native and -mavx, as they were");
}

CeresTrajectoryCost::CeresTrajectoryCost(std::vector<StateReference> states,
                                         std::unique_ptr<ceres::CostFunction> function,
                                         std::vector<StateRead> reads)
    : TrajectoryCost(function->num_residuals(), std::move(states)),
      function_(std::move(function)),
      reads_(std::move(reads)) {}

std::unique_ptr<CeresTrajectoryCost> CeresTrajectoryCost::CreateChecked(
    const Scene& scene, std::unique_ptr<ceres::CostFunction> function,
    std::vector<StateRead> reads) {
  for (size_t i = 0; i < reads.size(); ++i) {
    CheckRead(scene, reads[i], static_cast<int>(i));
  }
  CheckSizes(*function, reads);
  std::vector<StateReference> states = StatesOf(reads);
  return std::unique_ptr<CeresTrajectoryCost>(new CeresTrajectoryCost(
      std::move(states), std::move(function), std::move(reads)));
}

bool CeresTrajectoryCost::Evaluate(const Trajectory& trajectory, double* residuals,
                                   std::vector<StateDerivative>* derivatives) const {
  std::vector<Eigen::VectorXd> values;
  std::vector<const double*> blocks;
  for (const StateRead& read : reads_) values.push_back(Gather(trajectory, read));
  for (const Eigen::VectorXd& value : values) blocks.push_back(value.data());
  // What the function forgets to write fails as not finite, instead of being whatever
  // the memory held.
  std::fill_n(residuals, num_residuals(), std::numeric_limits<double>::quiet_NaN());
  if (derivatives == nullptr) {
    return function_->Evaluate(blocks.data(), residuals, nullptr);
  }
  std::vector<RowMajorMatrix> jacobians;
  for (const Eigen::VectorXd& value : values) {
    jacobians.push_back(RowMajorMatrix::Constant(
        num_residuals(), value.size(), std::numeric_limits<double>::quiet_NaN()));
  }
  std::vector<double*> jacobian_blocks;
  for (RowMajorMatrix& jacobian : jacobians) jacobian_blocks.push_back(jacobian.data());
  if (!function_->Evaluate(blocks.data(), residuals, jacobian_blocks.data())) {
    return false;
  }
  AppendDerivatives(trajectory, jacobians, derivatives);
  return true;
}

// One entry per state: the adjoint pass pays for every row of every entry.
void CeresTrajectoryCost::AppendDerivatives(
    const Trajectory& trajectory, const std::vector<RowMajorMatrix>& jacobians,
    std::vector<StateDerivative>* derivatives) const {
  for (const StateReference& state : states()) {
    std::vector<Eigen::Triplet<double>> d_position, d_velocity;
    bool reads_velocity = false;
    for (size_t i = 0; i < reads_.size(); ++i) {
      const StateRead& read = reads_[i];
      if (read.object != state.object || read.frame != state.frame) continue;
      const bool is_velocity = read.quantity == Quantity::kVelocity;
      reads_velocity |= is_velocity;
      Scatter(jacobians[i], read.vertices, is_velocity ? &d_velocity : &d_position);
    }
    StateDerivative derivative;
    derivative.object = state.object;
    derivative.frame = state.frame;
    const Eigen::Index size = trajectory.positions[state.object].rows();
    derivative.d_position.resize(num_residuals(), size);
    derivative.d_position.setFromTriplets(d_position.begin(), d_position.end());
    if (reads_velocity) {
      derivative.d_velocity.resize(num_residuals(), size);
      derivative.d_velocity.setFromTriplets(d_velocity.begin(), d_velocity.end());
    }
    derivatives->push_back(std::move(derivative));
  }
}

}  // namespace dpe
