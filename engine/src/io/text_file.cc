#include "io/text_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "dpe/engine/scene.h"

namespace dpe {
namespace {

namespace fs = std::filesystem;

// Throws unless `path` is a regular file.
void RequireRegularFile(const std::string& path, const std::string& expected) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (fs::is_regular_file(status)) return;
  std::string problem = "is not a regular file";
  if (status.type() == fs::file_type::not_found) {
    problem = "the file does not exist";
  } else if (!fs::exists(status)) {
    problem = "cannot be read: " + code.message();
  } else if (fs::is_directory(status)) {
    problem = "is a folder";
  }
  throw SceneError(path + ": " + problem + "; expected " + expected);
}

}  // namespace

std::string ReadTextFile(const std::string& path, const std::string& expected) {
  RequireRegularFile(path, expected);
  std::error_code code;
  const std::uintmax_t size = fs::file_size(path, code);
  if (code) throw SceneError(path + ": cannot be read: " + code.message());
  if (size > kMaxFileSize) {
    throw SceneError(path + ": has " + std::to_string(size) + " bytes; expected " +
                     expected + " of at most " + std::to_string(kMaxFileSize) +
                     " bytes (256 MiB)");
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

}  // namespace dpe
