#ifndef DPE_ENGINE_SRC_VALIDATION_OBJECT_VALIDATION_H_
#define DPE_ENGINE_SRC_VALIDATION_OBJECT_VALIDATION_H_

#include <string>

#include "dpe/engine/scene.h"
#include "validation/report.h"

namespace dpe {

// Checks one cloth by itself.
// @param path  of the object, like objects[0]
// @throws SceneError
void ValidateObject(const ClothObject& object, const std::string& path,
                    const ValidationReport& report);

}  // namespace dpe

#endif  // DPE_ENGINE_SRC_VALIDATION_OBJECT_VALIDATION_H_
