#include "experiments/machine.h"

#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <thread>

#include "experiments/executors/shell.h"

namespace dpe::experiments {
namespace {

std::string ProcessorModel() {
  std::ifstream info("/proc/cpuinfo");
  std::string line;
  while (std::getline(info, line)) {
    if (line.rfind("model name", 0) != 0) continue;
    const size_t colon = line.find(": ");
    if (colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

std::string Today() {
  const std::time_t now = std::time(nullptr);
  std::tm local = {};
  localtime_r(&now, &local);
  char text[16];
  return std::strftime(text, sizeof(text), "%Y-%m-%d", &local) > 0 ? text : "";
}

}  // namespace

Record ThisMachine() {
  Record machine;
  machine.Set("processor", ProcessorModel());
  machine.Set("cores", static_cast<int>(std::thread::hardware_concurrency()));
  machine.Set("date", Today());
  return machine;
}

std::string ProgramCommit(const std::string& program) {
  const std::string folder = std::filesystem::path(program).parent_path().string();
  const std::vector<std::string> git = {"git", "-C", folder};
  const auto run = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), git.begin(), git.end());
    return RunCommand(arguments);
  };
  const CommandResult commit = run({"rev-parse", "--short", "HEAD"});
  if (commit.exit_code != 0) return "";
  const std::string name = commit.out.substr(0, commit.out.find('\n'));
  const CommandResult status = run({"status", "--porcelain", "--untracked-files=no"});
  return name + (status.out.empty() ? "" : ", with changes");
}

}  // namespace dpe::experiments
