// From a JSON document to a scene; see scene_reader.cc for the keys.
#ifndef DPE_ENGINE_SRC_IO_SCENE_READER_H_
#define DPE_ENGINE_SRC_IO_SCENE_READER_H_

#include "dpe/engine/scene.h"
#include "io/json_node.h"

namespace dpe {

// Reads types and shapes; whether the values make sense is for ValidateScene to say.
// @throws SceneError
Scene ReadScene(const JsonNode& root);

}  // namespace dpe

#endif  // DPE_ENGINE_SRC_IO_SCENE_READER_H_
