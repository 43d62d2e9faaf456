// Residuals on simulated states from code that is written once, for any number type T:
// their derivatives are computed by ceres::Jet. A functor for a fixed number of
// vertices
//
//   struct DistanceToOrigin {
//     template <typename T>
//     bool operator()(const T* x, T* residual) const {
//       using std::sqrt;
//       residual[0] = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
//       return true;
//     }
//   };
//   costs.push_back(MakeAutodiffCost<1, 1>(scene, DistanceToOrigin(), {{0, 5, {17}}}));
//
// is given one array per StateRead, 3 numbers per vertex, and returns false where it
// cannot be evaluated (the optimiser then rejects the step). With that many derivatives
// in every Jet it is evaluated once per Jacobian.
//
// A functor that reads many vertices, or a number that is known at run time only, takes
// the arrays as `const T* const* states` and is evaluated ceil(numbers read / kStride)
// times per Jacobian, with kStride derivatives each.
//
// The guide is docs/custom_residuals.md.
#ifndef DPE_ESTIMATION_AUTODIFF_TRAJECTORY_COST_H_
#define DPE_ESTIMATION_AUTODIFF_TRAJECTORY_COST_H_

#include <ceres/autodiff_cost_function.h>
#include <ceres/dynamic_autodiff_cost_function.h>

#include <memory>
#include <utility>
#include <vector>

#include "dpe/engine/scene.h"
#include "dpe/estimation/ceres_trajectory_cost.h"
#include "dpe/estimation/trajectory_cost.h"

namespace dpe {

// A residual that reads as many arrays as there are kNumVertices, each of so many
// vertices: functor(const T* states_0, const T* states_1, ..., T* residuals).
//
// @throws SceneError as CeresTrajectoryCost::Create
template <int kNumResiduals, int... kNumVertices, typename Functor>
std::unique_ptr<TrajectoryCost> MakeAutodiffCost(const Scene& scene, Functor functor,
                                                 std::vector<StateRead> reads) {
  static_assert(kNumResiduals > 0, "a residual has at least one value");
  static_assert(sizeof...(kNumVertices) > 0 && ((kNumVertices > 0) && ...),
                "state how many vertices each read has: <residuals, vertices...>");
  using Function =
      ceres::AutoDiffCostFunction<Functor, kNumResiduals, 3 * kNumVertices...>;
  return CeresTrajectoryCost::Create(
      scene, std::make_unique<Function>(new Functor(std::move(functor))),
      std::move(reads));
}

// A residual whose number of values and of vertices is known at run time:
// functor(const T* const* states, T* residuals), states[i] being what reads[i] names.
//
// @param scene          the scene whose states are read
// @param functor        is copied
// @param reads          what it reads
// @param num_residuals  how many values it writes
// @throws SceneError as CeresTrajectoryCost::Create
template <int kStride = 12, typename Functor>
std::unique_ptr<TrajectoryCost> MakeDynamicAutodiffCost(const Scene& scene,
                                                        Functor functor,
                                                        std::vector<StateRead> reads,
                                                        int num_residuals) {
  using Function = ceres::DynamicAutoDiffCostFunction<Functor, kStride>;
  auto function = std::make_unique<Function>(new Functor(std::move(functor)));
  for (const StateRead& read : reads) {
    function->AddParameterBlock(3 * static_cast<int>(read.vertices.size()));
  }
  function->SetNumResiduals(num_residuals);
  return CeresTrajectoryCost::Create(scene, std::move(function), std::move(reads));
}

}  // namespace dpe

#endif  // DPE_ESTIMATION_AUTODIFF_TRAJECTORY_COST_H_
