// JSON text to a document, with errors that say where in the text they are.
#ifndef DPE_ENGINE_SRC_IO_JSON_IO_H_
#define DPE_ENGINE_SRC_IO_JSON_IO_H_

#include <nlohmann/json.hpp>
#include <string>

namespace dpe {

using Json = nlohmann::json;

// Parses JSON with // and /* */ comments.
//
// @param name  stands for the file in messages
// @throws SceneError naming file, JSON path, line and column for text that is not JSON,
//         numbers that no double can hold, keys given twice and absurdly deep nesting
Json ParseJsonDocument(const std::string& text, const std::string& name);

}  // namespace dpe

#endif  // DPE_ENGINE_SRC_IO_JSON_IO_H_
