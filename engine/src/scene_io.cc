#include "dpe/engine/scene_io.h"

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "io/json_io.h"
#include "io/json_node.h"
#include "io/scene_reader.h"

namespace dpe {
namespace {

// A cloth of 192 x 192 vertices takes 20 MB; a larger file than this is a mistake, and
// its document would need tens of gigabytes.
constexpr std::uintmax_t kMaxFileSize = std::uintmax_t{256} << 20;  // bytes

std::string ReadSceneFile(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (!fs::exists(status)) {
    const bool is_absent = status.type() == fs::file_type::not_found;
    throw SceneError(path + ": " +
                     (is_absent ? "the file does not exist" : code.message()) +
                     "; expected a scene file");
  }
  if (!fs::is_regular_file(status)) {
    throw SceneError(path + ": is " +
                     (fs::is_directory(status) ? "a folder" : "not a regular file") +
                     "; expected a scene file");
  }
  const std::uintmax_t size = fs::file_size(path, code);
  if (code) throw SceneError(path + ": cannot be read: " + code.message());
  if (size > kMaxFileSize) {
    throw SceneError(path + ": has " + std::to_string(size) +
                     " bytes; expected a scene file of at most " +
                     std::to_string(kMaxFileSize) + " bytes (256 MiB)");
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw SceneError(path + ": cannot be read: " + std::strerror(errno));
  std::string text(size, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(size));
  if (stream.bad())
    throw SceneError(path + ": cannot be read: " + std::strerror(errno));
  text.resize(static_cast<size_t>(stream.gcount()));
  return text;
}

}  // namespace

Scene ParseScene(const std::string& text, const std::string& name,
                 std::vector<std::string>* warnings) {
  const Json document = ParseJsonDocument(text, name);
  JsonContext context{name, warnings};
  Scene scene = ReadScene(JsonNode(document, "", &context));
  ValidateScene(scene, name, warnings);
  return scene;
}

Scene LoadScene(const std::string& path, std::vector<std::string>* warnings) {
  return ParseScene(ReadSceneFile(path), path, warnings);
}

void SaveScene(const Scene& scene, const std::string& path) {
  // What is written can be read: a scene that LoadScene would refuse is refused here.
  ValidateScene(scene, path);
  WriteFileAtomically(path, SceneToJson(scene));
}

}  // namespace dpe
