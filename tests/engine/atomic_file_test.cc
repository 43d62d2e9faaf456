#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <filesystem>

#include "dpe/engine/scene_io.h"
#include "support/temp_dir.h"

namespace dpe::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

int NumFiles(const TempDir& folder) {
  int count = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder.path())) {
    ++count;
  }
  return count;
}

std::string ErrorOfWriting(const std::string& path, const std::string& content) {
  try {
    WriteFileAtomically(path, content);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

// While it lives, files cannot grow beyond `bytes`: what a full disk looks like.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    old_handler_ = signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &old_limit_);
    rlimit limit = old_limit_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &old_limit_);
    signal(SIGXFSZ, old_handler_);
  }

 private:
  rlimit old_limit_ = {};
  void (*old_handler_)(int) = nullptr;
};

TEST(AtomicFile, WritesAndReplaces) {
  const TempDir folder;
  const std::string path = folder.File("out");
  WriteFileAtomically(path, "first");
  WriteFileAtomically(path, std::string("second\0half", 11));
  EXPECT_EQ(ReadFile(path), std::string("second\0half", 11));
  EXPECT_EQ(NumFiles(folder), 1);
}

TEST(AtomicFile, AFailedWriteLeavesTheOldFileAndNothingElse) {
  const TempDir folder;
  const std::string path = folder.File("out");
  WriteFile(path, "old");
  std::string message;
  {
    const FileSizeLimit limit(1000);
    message = ErrorOfWriting(path, std::string(100000, 'x'));
  }
  EXPECT_THAT(message, AllOf(HasSubstr(path), HasSubstr("File too large")));
  EXPECT_EQ(ReadFile(path), "old");
  EXPECT_EQ(NumFiles(folder), 1);
}

TEST(AtomicFile, PlacesThatCannotBeWrittenAreNamed) {
  const TempDir folder;
  const std::string absent = folder.File("absent") + "/out";
  EXPECT_THAT(ErrorOfWriting(absent, "x"),
              AllOf(HasSubstr(absent), HasSubstr("No such file or directory")));
  EXPECT_THAT(ErrorOfWriting(folder.path(), "x"), HasSubstr("is a folder"));
  EXPECT_THAT(ErrorOfWriting("/dev/null", "x"), HasSubstr("not a regular file"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_EQ(NumFiles(folder), 0);
}

TEST(AtomicFile, ASymbolicLinkStaysOne) {
  const TempDir folder;
  WriteFile(folder.File("real"), "old");
  fs::create_symlink(folder.File("real"), folder.File("link"));
  WriteFileAtomically(folder.File("link"), "new");
  EXPECT_TRUE(fs::is_symlink(folder.File("link")));
  EXPECT_EQ(ReadFile(folder.File("real")), "new");
}

}  // namespace
}  // namespace dpe::test
