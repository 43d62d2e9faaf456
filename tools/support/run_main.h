// The frame of every command line program: flags, --help, errors and exit codes.
#ifndef DPE_TOOLS_SUPPORT_RUN_MAIN_H_
#define DPE_TOOLS_SUPPORT_RUN_MAIN_H_

#include <functional>
#include <string>

namespace dpe::tools {

struct Program {
  std::string name;         // stands before error messages
  std::string summary;      // what it does, one sentence
  std::string usage;        // what follows the name: "--scene FILE --output FILE"
  std::string source_file;  // __FILE__ of main: --help lists the flags of its folder
  // Receives the one argument that is not a flag, if the program takes one.
  std::string* argument = nullptr;
};

// Parses the flags (gflags), then runs `body` and returns its exit code.
//
// --help prints summary, usage and the program's own flags to stdout and returns 0.
// Unknown flags, values that a flag cannot take and leftover positional arguments end
// the program with exit code 1 before `body` runs. A SceneError (or any other standard
// exception) leaving `body` is printed to stderr as "NAME: error: MESSAGE"; the exit
// code is then 1.
int RunMain(int argc, char** argv, const Program& program,
            const std::function<int()>& body);

// True if the flag was set on the command line, even if to its default.
bool FlagIsGiven(const std::string& flag);

}  // namespace dpe::tools

#endif  // DPE_TOOLS_SUPPORT_RUN_MAIN_H_
