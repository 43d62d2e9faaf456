#include "experiments/requirements/timed_program.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace dpe::experiments {
namespace {

constexpr int kCannotStart = 127;

std::string ReadAll(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

bool Redirect(const char* file, int flags, int descriptor) {
  const int opened = open(file, flags, 0600);
  return opened >= 0 && dup2(opened, descriptor) >= 0;
}

double Seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

ScratchFolder::ScratchFolder() {
  std::string pattern =
      (std::filesystem::temp_directory_path() / "dpe_cost_XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) {
    throw std::runtime_error(pattern + ": " + std::strerror(errno));
  }
  path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

TimedResult RunTimed(const std::vector<std::string>& command) {
  std::vector<char*> argv;
  for (const std::string& argument : command) {
    argv.push_back(const_cast<char*>(argument.c_str()));
  }
  argv.push_back(nullptr);
  // Files rather than pipes: nothing can fill up and block.
  const ScratchFolder folder;
  const std::string out = folder.File("out"), err = folder.File("err");
  const pid_t child = fork();
  if (child < 0) {
    throw std::runtime_error(std::string("fork: ") + std::strerror(errno));
  }
  if (child == 0) {
    constexpr int kWrite = O_WRONLY | O_CREAT | O_TRUNC;
    if (Redirect("/dev/null", O_RDONLY, STDIN_FILENO) &&
        Redirect(out.c_str(), kWrite, STDOUT_FILENO) &&
        Redirect(err.c_str(), kWrite, STDERR_FILENO)) {
      execvp(argv[0], argv.data());
    }
    _exit(kCannotStart);
  }
  int status = 0;
  rusage usage = {};
  while (wait4(child, &status, 0, &usage) < 0) {
    if (errno != EINTR) {
      throw std::runtime_error(std::string("wait4: ") + std::strerror(errno));
    }
  }
  TimedResult result;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  if (result.exit_code == kCannotStart) {
    throw std::runtime_error(command[0] + " could not be started");
  }
  result.cpu_s = Seconds(usage.ru_utime) + Seconds(usage.ru_stime);
  result.out = ReadAll(out);
  result.err = ReadAll(err);
  return result;
}

}  // namespace dpe::experiments
