#include <fcntl.h>
#include <stdio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>
#include <system_error>

#include "dpe/engine/scene_io.h"

namespace dpe {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void Fail(const std::string& path, int error) {
  throw SceneError(path + ": cannot be written: " + std::strerror(error));
}

// The file that is to be replaced: what a symbolic link points to, rather than the
// link.
fs::path Target(const std::string& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    // Renaming onto a device would replace it by a file.
    throw SceneError(path + ": is " +
                     (fs::is_directory(status) ? "a folder" : "not a regular file") +
                     "; expected the name of a file to write");
  }
  return fs::is_symlink(path, ignored) ? fs::weakly_canonical(path) : fs::path(path);
}

// Deletes the temporary file unless it has become the real one.
class TemporaryFile {
 public:
  TemporaryFile(const fs::path& folder, const std::string& path) : path_(path) {
    static std::atomic<int> counter{0};
    name_ = folder / (".dpe-" + std::to_string(getpid()) + "-" +
                      std::to_string(counter++) + ".tmp");
    descriptor_ = open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0) Fail(path_, errno);
  }

  ~TemporaryFile() {
    if (descriptor_ >= 0) close(descriptor_);
    if (!name_.empty()) unlink(name_.c_str());
  }

  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void Write(const std::string& content) {
    size_t written = 0;
    while (written < content.size()) {
      const ssize_t count =
          write(descriptor_, content.data() + written, content.size() - written);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) Fail(path_, errno);
      written += static_cast<size_t>(count);
    }
    // Some file systems report a full disk only here, and a rename that reaches the
    // disk before the content would leave an empty file after a power cut.
    if (fsync(descriptor_) != 0) Fail(path_, errno);
    const int closed = close(descriptor_);
    descriptor_ = -1;
    if (closed != 0) Fail(path_, errno);
  }

  void RenameTo(const fs::path& target) {
    if (rename(name_.c_str(), target.c_str()) != 0) Fail(path_, errno);
    name_.clear();
  }

 private:
  std::string path_;  // for messages
  std::string name_;
  int descriptor_ = -1;
};

}  // namespace

void WriteFileAtomically(const std::string& path, const std::string& content) {
  const fs::path target = Target(path);
  TemporaryFile file(target.parent_path(), path);
  file.Write(content);
  file.RenameTo(target);
}

}  // namespace dpe
