// A folder of its own for a test, and whole files in and out.
#ifndef DPE_TESTS_SUPPORT_TEMP_DIR_H_
#define DPE_TESTS_SUPPORT_TEMP_DIR_H_

#include <string>

namespace dpe::test {

// A new empty folder, removed with all its content when the object dies.
class TempDir {
 public:
  TempDir();
  ~TempDir();
  TempDir(const TempDir&) = delete;
  TempDir& operator=(const TempDir&) = delete;

  const std::string& path() const { return path_; }
  // The path of a file of this name in the folder.
  std::string File(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

// Both throw std::runtime_error if the file cannot be read or written.
std::string ReadFile(const std::string& path);
void WriteFile(const std::string& path, const std::string& content);

}  // namespace dpe::test

#endif  // DPE_TESTS_SUPPORT_TEMP_DIR_H_
