#include "experiments/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "dpe/engine/scene.h"

namespace dpe::experiments {

FolderLock::FolderLock(const std::string& dir) {
  const std::string path = dir + "/.lock";
  descriptor_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw SceneError(path + ": " + std::strerror(errno));
  if (flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  const int error = errno;
  close(descriptor_);
  if (error == EWOULDBLOCK) {
    throw SceneError(dir +
                     ": another run_experiments is working in this folder; wait "
                     "for it, stop it, or take another --output_dir");
  }
  throw SceneError(path + ": " + std::strerror(error));
}

FolderLock::~FolderLock() { close(descriptor_); }

}  // namespace dpe::experiments
