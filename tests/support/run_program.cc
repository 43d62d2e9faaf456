#include "support/run_program.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>
#include <thread>

#include "support/temp_dir.h"

namespace dpe::test {
namespace {

constexpr int kCannotStart = 127;

double Now() {
  const auto time = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(time).count();
}

bool Redirect(const char* file, int flags, int descriptor) {
  const int opened = open(file, flags, 0600);
  return opened >= 0 && dup2(opened, descriptor) >= 0;
}

// Runs in the child: only calls that are safe between fork and exec.
[[noreturn]] void Execute(const char* path, char* const* argv, const char* out,
                          const char* err, const char* directory) {
  constexpr int kWrite = O_WRONLY | O_CREAT | O_TRUNC;
  if (Redirect("/dev/null", O_RDONLY, STDIN_FILENO) &&
      Redirect(out, kWrite, STDOUT_FILENO) && Redirect(err, kWrite, STDERR_FILENO) &&
      (*directory == '\0' || chdir(directory) == 0)) {
    execv(path, argv);
  }
  _exit(kCannotStart);
}

// Waits for the child, sending SIGINT and SIGKILL when their times have come.
int Wait(pid_t child, double start, const RunProgramOptions& options, bool* timed_out,
         rusage* usage) {
  bool interrupted = options.interrupt_after <= 0.0;
  int status = 0;
  while (wait4(child, &status, WNOHANG, usage) == 0) {
    const double elapsed = Now() - start;
    if (!interrupted && elapsed >= options.interrupt_after) {
      kill(child, SIGINT);
      interrupted = true;
    }
    if (!*timed_out && elapsed >= options.timeout) {
      kill(child, SIGKILL);
      *timed_out = true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return status;
}

}  // namespace

ProgramResult RunProgram(const std::string& program,
                         const std::vector<std::string>& arguments,
                         const RunProgramOptions& options) {
  const bool is_path = program.find('/') != std::string::npos;
  const std::string path = is_path ? program : std::string(DPE_BIN_DIR) + "/" + program;
  if (access(path.c_str(), X_OK) != 0) {
    throw std::runtime_error(path + " is not an executable file: is it built?");
  }
  std::vector<char*> argv = {const_cast<char*>(path.c_str())};
  for (const std::string& argument : arguments) {
    argv.push_back(const_cast<char*>(argument.c_str()));
  }
  argv.push_back(nullptr);

  // Files rather than pipes: nothing can fill up and block.
  const TempDir folder;
  const std::string out = folder.File("out"), err = folder.File("err");
  const double start = Now();
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot fork");
  if (child == 0) {
    Execute(path.c_str(), argv.data(), out.c_str(), err.c_str(),
            options.working_directory.c_str());
  }
  ProgramResult result;
  rusage usage = {};
  const int status = Wait(child, start, options, &result.timed_out, &usage);
  result.seconds = Now() - start;
  result.peak_mib = static_cast<double>(usage.ru_maxrss) / 1024.0;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  if (result.exit_code == kCannotStart) {
    throw std::runtime_error(path + " could not be started");
  }
  result.out = ReadFile(out);
  result.err = ReadFile(err);
  return result;
}

}  // namespace dpe::test
