#include "experiments/executors/internal.h"

#include <string>

#include "experiments/executors/worker.h"

namespace dpe::experiments {
namespace {

constexpr char kJob[] = "--internal_job";

}  // namespace

bool IsInternalCommand(int argc, char** argv) {
  return argc == 5 && argv[1] == std::string(kJob);
}

int RunInternalCommand(int, char** argv) {
  return RunJobProcess(argv[2], argv[3], argv[4]);
}

}  // namespace dpe::experiments
