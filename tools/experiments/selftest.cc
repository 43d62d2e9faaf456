#include "experiments/selftest.h"

#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "dpe/engine/scene.h"
#include "experiments/arguments.h"

namespace dpe::experiments {
namespace {

void Act(const std::string& action) {
  if (action == "none") return;
  if (action == "throw") throw SceneError("thrown as asked for");
  // A null pointer is a thing that compilers and sanitizers have opinions about.
  if (action == "segfault") raise(SIGSEGV);
  if (action == "kill") raise(SIGKILL);
  if (action == "abort") std::abort();
  if (action == "exit") _exit(7);
  if (action == "loop") {
    while (true) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  throw SceneError(
      "action: \"" + action +
      "\" is not accepted; expected none, throw, segfault, kill, abort, exit "
      "or loop");
}

Record Run(const Job& job) {
  RequireKnownArguments(job, {"count_file", "sleep", "value", "action"});
  const std::string count_file = job.Text("count_file", "");
  if (!count_file.empty()) {
    // One write of a short line to a file that is opened for appending is not torn.
    std::ofstream file(count_file, std::ios::app);
    file << job.Text("id", "") + "\n" << std::flush;
    if (!file) throw SceneError("count_file: " + count_file + " cannot be written");
  }
  std::this_thread::sleep_for(std::chrono::duration<double>(job.Number("sleep", 0.0)));
  Record result;
  const double value = job.Number("value", 0.0);
  result.Set("square", value * value);
  Act(job.Text("action", "none"));
  return result;
}

}  // namespace

JobKind SelfTestKind() {
  return {"selftest",
          "does what it is told (sleep, value, action, count_file), to try an executor",
          Run};
}

}  // namespace dpe::experiments
