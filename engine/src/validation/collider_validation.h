#ifndef DPE_ENGINE_SRC_VALIDATION_COLLIDER_VALIDATION_H_
#define DPE_ENGINE_SRC_VALIDATION_COLLIDER_VALIDATION_H_

#include <vector>

#include "dpe/engine/scene.h"
#include "validation/report.h"

namespace dpe {

// @throws SceneError
void ValidateColliders(const std::vector<Collider>& colliders,
                       const ValidationReport& report);

}  // namespace dpe

#endif  // DPE_ENGINE_SRC_VALIDATION_COLLIDER_VALIDATION_H_
