#include "experiments/executors/shell.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "dpe/engine/scene.h"

namespace dpe::experiments {
namespace {

constexpr int kNoSuchProgram = 127;

// Runs in the child: only calls that are safe between fork and exec.
[[noreturn]] void Execute(char* const* argv, int out, int err) {
  setpgid(0, 0);
  const int input = open("/dev/null", O_RDONLY);
  if (input >= 0 && dup2(input, STDIN_FILENO) >= 0 && dup2(out, STDOUT_FILENO) >= 0 &&
      dup2(err, STDERR_FILENO) >= 0) {
    execvp(argv[0], argv);
  }
  _exit(kNoSuchProgram);
}

struct Pipe {
  Pipe() {
    if (pipe(ends) != 0) {
      throw SceneError(std::string("cannot make a pipe: ") + std::strerror(errno));
    }
    for (const int end : ends) fcntl(end, F_SETFD, FD_CLOEXEC);
  }
  ~Pipe() {
    CloseEnd(0);
    CloseEnd(1);
  }
  void CloseEnd(int end) {
    if (ends[end] >= 0) close(ends[end]);
    ends[end] = -1;
  }
  int ends[2] = {-1, -1};
};

// Both at once, because a program that fills one pipe waits until somebody reads it.
void ReadBoth(Pipe* out, Pipe* err, CommandResult* result) {
  std::array<pollfd, 2> polled = {
      {{out->ends[0], POLLIN, 0}, {err->ends[0], POLLIN, 0}}};
  const std::array<std::string*, 2> texts = {&result->out, &result->err};
  int num_open = 2;
  char buffer[4096];
  while (num_open > 0) {
    if (poll(polled.data(), polled.size(), -1) < 0) {
      if (errno == EINTR) continue;
      return;
    }
    for (size_t i = 0; i < polled.size(); ++i) {
      if (polled[i].fd < 0 || polled[i].revents == 0) continue;
      const ssize_t count = read(polled[i].fd, buffer, sizeof(buffer));
      if (count > 0) {
        texts[i]->append(buffer, static_cast<size_t>(count));
      } else if (count == 0 || errno != EINTR) {
        polled[i].fd = -1;
        --num_open;
      }
    }
  }
}

}  // namespace

CommandResult RunCommand(const std::vector<std::string>& arguments) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) {
    argv.push_back(const_cast<char*>(argument.c_str()));
  }
  argv.push_back(nullptr);
  Pipe out, err;
  const pid_t child = fork();
  if (child < 0) {
    throw SceneError(arguments[0] + ": cannot be started: " + std::strerror(errno));
  }
  if (child == 0) Execute(argv.data(), out.ends[1], err.ends[1]);
  out.CloseEnd(1);
  err.CloseEnd(1);
  CommandResult result;
  ReadBoth(&out, &err, &result);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return result;
}

}  // namespace dpe::experiments
