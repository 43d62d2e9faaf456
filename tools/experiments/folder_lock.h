// Keeps two programs from working in one folder at once.
#ifndef DPE_TOOLS_EXPERIMENTS_FOLDER_LOCK_H_
#define DPE_TOOLS_EXPERIMENTS_FOLDER_LOCK_H_

#include <string>

namespace dpe::experiments {

// Held until it dies, or the process does, however that ends. The processes of jobs do
// not inherit it.
class FolderLock {
 public:
  // @throws SceneError naming the folder if it is held already, or cannot be locked
  explicit FolderLock(const std::string& dir);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_FOLDER_LOCK_H_
