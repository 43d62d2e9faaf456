// Runs other programs (sbatch, gnuplot, git) and takes what they say.
#ifndef DPE_TOOLS_EXPERIMENTS_EXECUTORS_SHELL_H_
#define DPE_TOOLS_EXPERIMENTS_EXECUTORS_SHELL_H_

#include <string>
#include <vector>

namespace dpe::experiments {

struct CommandResult {
  int exit_code = -1;  // 127: there is no such program; minus the signal that ended it
  std::string out;     // stdout
  std::string err;     // stderr
};

// Runs a program that is looked for in PATH, without a shell, with empty input, and
// waits for it. It is in a process group of its own, so that Ctrl-C does not end it.
// @throws SceneError if no process can be made
CommandResult RunCommand(const std::vector<std::string>& arguments);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_EXECUTORS_SHELL_H_
