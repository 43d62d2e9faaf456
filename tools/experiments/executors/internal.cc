#include "experiments/executors/internal.h"

#ifdef __APPLE__
#include <mach-o/dyld.h>
#endif

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "dpe/engine/scene.h"
#include "experiments/executors/slurm.h"
#include "experiments/executors/worker.h"

namespace dpe::experiments {
namespace {

constexpr char kJob[] = "--internal_job";
constexpr char kTask[] = "--internal_task";

}  // namespace

bool IsInternalCommand(int argc, char** argv) {
  return (argc == 5 && argv[1] == std::string(kJob)) ||
         (argc == 6 && argv[1] == std::string(kTask));
}

int RunInternalCommand(char** argv) {
  if (argv[1] == std::string(kJob)) return RunJobProcess(argv[2], argv[3], argv[4]);
  return RunSlurmTask(ProgramPath(), argv[2], argv[3], std::atoi(argv[4]),
                      std::atof(argv[5]));
}

std::string ProgramPath() {
  namespace fs = std::filesystem;
  std::error_code error;
#ifdef __APPLE__
  char name[4096];
  std::uint32_t size = sizeof(name);
  const fs::path link = _NSGetExecutablePath(name, &size) == 0 ? name : "";
  const fs::path path = fs::canonical(link, error);
#else
  const fs::path path = fs::read_symlink("/proc/self/exe", error);
#endif
  if (error) {
    throw SceneError("cannot find out which program this is: " + error.message());
  }
  return path.string();
}

}  // namespace dpe::experiments
