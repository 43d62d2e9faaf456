// The coordinates in which an optimiser sees the parameters.
//
//   mass, stiffness, damping, drag:  q = ln p,  p = exp q,  dp/dq = p
//   wind, initial velocity:          q = p
//
// The logarithm keeps positive quantities positive without bounds (with an active bound
// trust-region methods may stop at a wrong point) and makes a step mean a relative
// change, whatever the unit.
#ifndef DPE_ESTIMATION_PARAMETERIZATION_H_
#define DPE_ESTIMATION_PARAMETERIZATION_H_

#include <Eigen/Core>
#include <vector>

#include "dpe/engine/parameters.h"
#include "dpe/estimation/export.h"

namespace dpe {

class DPE_ESTIMATION_API ParameterMap {
 public:
  // The least value that a positive quantity can start from, in its SI unit.
  static constexpr double kFloor = 1e-12;

  ParameterMap() = default;
  explicit ParameterMap(const ParameterLayout& layout);

  int size() const { return static_cast<int>(is_log_.size()); }
  bool is_log(int parameter) const { return is_log_[parameter] != 0; }

  // q -> p, SI units.
  Eigen::VectorXd ToParameters(const Eigen::VectorXd& coordinates) const;

  // p -> q. Values of positive kinds below kFloor are raised to it first.
  // @param parameters  p, layout order, SI units
  // @param num_raised  if not null, receives how many were
  Eigen::VectorXd ToCoordinates(const Eigen::VectorXd& parameters,
                                int* num_raised = nullptr) const;

  // dp/dq, one number per parameter (the map acts on each alone).
  Eigen::VectorXd Derivative(const Eigen::VectorXd& coordinates) const;

 private:
  std::vector<char> is_log_;
};

}  // namespace dpe

#endif  // DPE_ESTIMATION_PARAMETERIZATION_H_
