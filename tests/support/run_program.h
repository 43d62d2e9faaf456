// Runs one of the project's programs as its users do and captures what it says.
#ifndef DPE_TESTS_SUPPORT_RUN_PROGRAM_H_
#define DPE_TESTS_SUPPORT_RUN_PROGRAM_H_

#include <string>
#include <vector>

namespace dpe::test {

struct ProgramResult {
  int exit_code = -1;  // minus the signal's number if a signal ended it
  bool timed_out = false;
  double seconds = 0.0;   // wall-clock time
  double peak_mib = 0.0;  // the most memory that was resident at once
  std::string out;        // stdout
  std::string err;        // stderr
};

struct RunProgramOptions {
  std::string working_directory;  // empty: that of the test
  double timeout = 120.0;         // s; then it is killed
  double interrupt_after = 0.0;   // s; if positive, SIGINT is sent then (Ctrl-C)
};

// Runs a program with the given arguments (no shell is involved) and waits for it.
//
// @param program  a name in the build's bin/ folder, or a path
// @throws std::runtime_error if the program cannot be started
ProgramResult RunProgram(const std::string& program,
                         const std::vector<std::string>& arguments,
                         const RunProgramOptions& options = {});

}  // namespace dpe::test

#endif  // DPE_TESTS_SUPPORT_RUN_PROGRAM_H_
