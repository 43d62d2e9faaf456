// Which parameters a prior is about: from its description to rows.
#ifndef DPE_ESTIMATION_PRIOR_TARGETS_H_
#define DPE_ESTIMATION_PRIOR_TARGETS_H_

#include <vector>

#include "dpe/engine/parameters.h"
#include "dpe/engine/scene.h"
#include "dpe/estimation/priors.h"
#include "prior_rows.h"

namespace dpe {

// Both append to the rows of the layout's blocks, one vector per block, and throw
// SceneError as PriorRows does.
void AddValueRows(const Scene& scene, const ParameterLayout& layout, const Prior& prior,
                  std::vector<std::vector<PriorRows::Row>>* of_block);
void AddDifferenceRows(const Scene& scene, const ParameterLayout& layout,
                       const SmoothnessPrior& smoothness,
                       std::vector<std::vector<PriorRows::Row>>* of_block);

}  // namespace dpe

#endif  // DPE_ESTIMATION_PRIOR_TARGETS_H_
