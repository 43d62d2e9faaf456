// Runs a program and waits for it.
#ifndef DPE_TOOLS_EXPERIMENTS_REQUIREMENTS_TIMED_PROGRAM_H_
#define DPE_TOOLS_EXPERIMENTS_REQUIREMENTS_TIMED_PROGRAM_H_

#include <string>
#include <vector>

namespace dpe::experiments {

struct TimedResult {
  int exit_code = -1;  // minus the signal's number if a signal ended it
  double cpu_s = 0.0;  // processor time, user and system
  std::string out;     // what it wrote to stdout
  std::string err;     // and to stderr
};

// @param command  program (a path, or a name that is looked for in PATH) and arguments;
//                 no shell is involved
// @throws std::runtime_error if the program cannot be started
TimedResult RunTimed(const std::vector<std::string>& command);

// A new empty folder, removed with all its content when the object dies.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::string File(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_REQUIREMENTS_TIMED_PROGRAM_H_
