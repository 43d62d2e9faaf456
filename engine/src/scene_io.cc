#include "dpe/engine/scene_io.h"

#include "io/json_io.h"
#include "io/json_node.h"
#include "io/scene_reader.h"
#include "io/text_file.h"

namespace dpe {

Scene ParseScene(const std::string& text, const std::string& name,
                 std::vector<std::string>* warnings) {
  const Json document = ParseJsonDocument(text, name);
  JsonContext context{name, warnings};
  Scene scene = ReadScene(JsonNode(document, "", &context));
  ValidateScene(scene, name, warnings);
  return scene;
}

Scene LoadScene(const std::string& path, std::vector<std::string>* warnings) {
  return ParseScene(ReadTextFile(path, "a scene file"), path, warnings);
}

void SaveScene(const Scene& scene, const std::string& path) {
  // What is written can be read: a scene that LoadScene would refuse is refused here.
  ValidateScene(scene, path);
  const std::string text = SceneToJson(scene);
  if (text.size() > kMaxFileSize) {
    throw SceneError(path + ": the scene takes " + std::to_string(text.size()) +
                     " bytes; expected at most " + std::to_string(kMaxFileSize) +
                     " bytes (256 MiB)");
  }
  WriteFileAtomically(path, text);
}

}  // namespace dpe
