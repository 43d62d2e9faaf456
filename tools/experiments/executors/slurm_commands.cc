#include "experiments/executors/slurm_commands.h"

#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <sstream>
#include <thread>

#include "dpe/engine/scene.h"
#include "experiments/executors/shell.h"

namespace dpe::experiments {
namespace {

constexpr int kDefaultMaxArraySize = 1001;
// A controller that is being restarted is back in seconds.
constexpr int kQueueAttempts = 6;
constexpr std::chrono::seconds kBetweenAttempts(5);

std::vector<std::string> Fields(const std::string& line, size_t count) {
  std::vector<std::string> fields;
  std::istringstream text(line);
  std::string field;
  while (fields.size() + 1 < count && std::getline(text, field, '|')) {
    fields.push_back(field);
  }
  if (std::getline(text, field)) fields.push_back(field);
  return fields;
}

std::string FirstLine(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

[[noreturn]] void Fail(const std::string& program, const CommandResult& result) {
  if (result.exit_code == 127) {
    throw SceneError("--executor: slurm: " + program +
                     " was not found; run this on a machine from which jobs are "
                     "submitted to Slurm, or use --executor local");
  }
  throw SceneError(
      program + " failed: " + FirstLine(result.err.empty() ? result.out : result.err));
}

}  // namespace

std::vector<QueuedTask> ParseQueue(const std::string& lines,
                                   const std::string& prefix) {
  std::vector<QueuedTask> tasks;
  std::istringstream text(lines);
  std::string line;
  while (std::getline(text, line)) {
    const std::vector<std::string> fields = Fields(line, 4);
    if (fields.size() != 4 || fields[3].rfind(prefix, 0) != 0) continue;
    char* end = nullptr;
    const long index = std::strtol(fields[1].c_str(), &end, 10);
    if (fields[1].empty() || *end != '\0') continue;
    tasks.push_back(
        {fields[0], fields[3], static_cast<int>(index), fields[2] != "PENDING"});
  }
  return tasks;
}

std::vector<QueuedTask> ReadQueue(const std::string& prefix) {
  CommandResult result;
  for (int attempt = 0; attempt < kQueueAttempts; ++attempt) {
    if (attempt > 0) std::this_thread::sleep_for(kBetweenAttempts);
    result = RunCommand({"squeue", "--noheader", "--array", "--user",
                         std::to_string(getuid()), "--format", "%F|%K|%T|%j"});
    if (result.exit_code == 0) return ParseQueue(result.out, prefix);
    if (result.exit_code == 127) break;
  }
  Fail("squeue", result);
}

int MaxArraySize() {
  const CommandResult result = RunCommand({"scontrol", "show", "config"});
  std::istringstream text(result.out);
  std::string line;
  while (std::getline(text, line)) {
    if (line.rfind("MaxArraySize", 0) != 0) continue;
    const size_t equals = line.find('=');
    if (equals == std::string::npos) continue;
    const int size = std::atoi(line.c_str() + equals + 1);
    if (size > 0) return size;
  }
  return kDefaultMaxArraySize;
}

std::string SubmitArray(const std::vector<std::string>& options,
                        const std::string& script) {
  std::vector<std::string> command = {"sbatch", "--parsable"};
  command.insert(command.end(), options.begin(), options.end());
  command.push_back(script);
  const CommandResult result = RunCommand(command);
  if (result.exit_code != 0) Fail("sbatch", result);
  const std::string answer = FirstLine(result.out);
  return answer.substr(0, answer.find(';'));  // NUMBER;CLUSTER
}

void CancelArrays(const std::set<std::string>& arrays) {
  if (arrays.empty()) return;
  std::vector<std::string> command = {"scancel"};
  command.insert(command.end(), arrays.begin(), arrays.end());
  RunCommand(command);
}

}  // namespace dpe::experiments
