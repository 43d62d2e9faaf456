#include "dpe/estimation/parameterization.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dpe {
namespace {

// Far out exp underflows to 0, which is no positive number any more.
double PositiveExp(double q) {
  return std::max(std::exp(q), std::numeric_limits<double>::min());
}

}  // namespace

ParameterMap::ParameterMap(const ParameterLayout& layout) : is_log_(layout.size(), 0) {
  for (const ParameterBlock& block : layout.blocks()) {
    for (int i = 0; i < block.size; ++i) {
      is_log_[block.offset + i] = ParameterKindIsPositive(block.kind) ? 1 : 0;
    }
  }
}

Eigen::VectorXd ParameterMap::ToParameters(const Eigen::VectorXd& coordinates) const {
  Eigen::VectorXd parameters = coordinates;
  for (int i = 0; i < size(); ++i) {
    if (is_log_[i]) parameters[i] = PositiveExp(coordinates[i]);
  }
  return parameters;
}

Eigen::VectorXd ParameterMap::ToCoordinates(const Eigen::VectorXd& parameters,
                                            int* num_raised) const {
  Eigen::VectorXd coordinates = parameters;
  int raised = 0;
  for (int i = 0; i < size(); ++i) {
    if (!is_log_[i]) continue;
    // Negated, so that NaN is raised too.
    const bool too_small = !(parameters[i] >= kFloor);
    if (too_small) ++raised;
    coordinates[i] = std::log(too_small ? kFloor : parameters[i]);
  }
  if (num_raised != nullptr) *num_raised = raised;
  return coordinates;
}

Eigen::VectorXd ParameterMap::Derivative(const Eigen::VectorXd& coordinates) const {
  Eigen::VectorXd derivative = Eigen::VectorXd::Ones(size());
  for (int i = 0; i < size(); ++i) {
    if (is_log_[i]) derivative[i] = PositiveExp(coordinates[i]);
  }
  return derivative;
}

}  // namespace dpe
