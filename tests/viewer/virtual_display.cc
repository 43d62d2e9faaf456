#include "virtual_display.h"

#include <fcntl.h>
#include <signal.h>
#if defined(__linux__)
#include <sys/prctl.h>
#endif
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

namespace dpe::viewer {
namespace {

// The number of the display, which Xvfb writes when it is ready; empty if it ends
// before.
std::string ReadLine(int descriptor) {
  std::string line;
  char letter = 0;
  while (read(descriptor, &letter, 1) == 1 && letter != '\n') line += letter;
  return line;
}

}  // namespace

VirtualDisplay::VirtualDisplay() {
  int ends[2];
  if (pipe(ends) != 0) return;
  const std::string descriptor = std::to_string(ends[1]);
  process_ = fork();
  if (process_ == 0) {
    close(ends[0]);
    // It must not outlive a test that crashes, nor hold what reads the test's output.
#if defined(__linux__)
    prctl(PR_SET_PDEATHSIG, SIGTERM);
#endif
    const int nowhere = open("/dev/null", O_RDWR);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    execlp("Xvfb", "Xvfb", "-displayfd", descriptor.c_str(), "-screen", "0",
           "1280x1024x24", "-nolisten", "tcp", static_cast<char*>(nullptr));
    _exit(127);
  }
  close(ends[1]);
  const std::string number = process_ > 0 ? ReadLine(ends[0]) : "";
  close(ends[0]);
  if (number.empty()) {
    if (process_ > 0) waitpid(process_, nullptr, 0);
    process_ = -1;
    return;
  }
  const char* before = std::getenv("DISPLAY");
  if (before != nullptr) display_before_ = before;
  setenv("DISPLAY", (":" + number).c_str(), 1);
}

VirtualDisplay::~VirtualDisplay() {
  if (!runs()) return;
  kill(process_, SIGTERM);
  waitpid(process_, nullptr, 0);
  if (display_before_.empty()) {
    unsetenv("DISPLAY");
  } else {
    setenv("DISPLAY", display_before_.c_str(), 1);
  }
}

}  // namespace dpe::viewer
