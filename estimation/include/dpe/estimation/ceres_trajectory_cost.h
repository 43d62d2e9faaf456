// A ceres::CostFunction of simulated states as a TrajectoryCost.
//
//   r = f(s_0, s_1, ...),  s_i = positions (or velocities) of chosen vertices of one
//                                object at one frame, x, y, z of a vertex together
//
// Each s_i is one parameter block of the cost function, in the order of the reads. So
// whatever Ceres can make a cost function of is a residual here: an autodiff functor
// (autodiff_trajectory_cost.h), ceres::NumericDiffCostFunction around code that cannot
// be differentiated otherwise, or a ceres::SizedCostFunction with its Jacobian by hand.
// A residual with a sparse Jacobian of its own is better served by a TrajectoryCost
// subclass: between Ceres and this class Jacobians are dense.
#ifndef DPE_ESTIMATION_CERES_TRAJECTORY_COST_H_
#define DPE_ESTIMATION_CERES_TRAJECTORY_COST_H_

#include <ceres/cost_function.h>

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "dpe/engine/scene.h"
#include "dpe/estimation/export.h"
#include "dpe/estimation/trajectory_cost.h"

namespace dpe {

// What a residual reads: 3 numbers per vertex.
struct StateRead {
  enum class Quantity { kPosition, kVelocity };  // m, m/s

  int object = 0;
  int frame = 0;
  std::vector<int> vertices;  // in any order; one may appear twice
  Quantity quantity = Quantity::kPosition;
};

class DPE_ESTIMATION_API CeresTrajectoryCost : public TrajectoryCost {
 public:
  // @param scene     the scene whose states are read
  // @param function  its parameter block i has 3 numbers per vertex of reads[i]
  // @param reads     what it reads, in the order of its parameter blocks
  // @throws SceneError if a read names something that the scene does not have, or the
  //         sizes of the function do not fit the reads; the message says which
  //
  // Residuals are compiled by their users, and states are Eigen objects of the library:
  // compiler flags such as -mavx decide how Eigen aligns memory, and where the two
  // sides differ, memory would be released that was never allocated. So that is an
  // error too.
  template <int kEigenAlignment = EIGEN_MAX_ALIGN_BYTES>
  static std::unique_ptr<CeresTrajectoryCost> Create(
      const Scene& scene, std::unique_ptr<ceres::CostFunction> function,
      std::vector<StateRead> reads) {
    CheckEigenAlignment(kEigenAlignment);
    return CreateChecked(scene, std::move(function), std::move(reads));
  }

  bool Evaluate(const Trajectory& trajectory, double* residuals,
                std::vector<StateDerivative>* derivatives) const override;

 private:
  static void CheckEigenAlignment(int alignment);
  static std::unique_ptr<CeresTrajectoryCost> CreateChecked(
      const Scene& scene, std::unique_ptr<ceres::CostFunction> function,
      std::vector<StateRead> reads);

  CeresTrajectoryCost(std::vector<StateReference> states,
                      std::unique_ptr<ceres::CostFunction> function,
                      std::vector<StateRead> reads);

  void AppendDerivatives(const Trajectory& trajectory,
                         const std::vector<RowMajorMatrix>& jacobians,
                         std::vector<StateDerivative>* derivatives) const;

  std::unique_ptr<ceres::CostFunction> function_;
  std::vector<StateRead> reads_;
};

}  // namespace dpe

#endif  // DPE_ESTIMATION_CERES_TRAJECTORY_COST_H_
