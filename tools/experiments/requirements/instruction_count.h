// The instructions that a program executes in chosen functions and all that they call,
// counted by valgrind's callgrind. Other programs do not disturb the count, as they do
// every time.
#ifndef DPE_TOOLS_EXPERIMENTS_REQUIREMENTS_INSTRUCTION_COUNT_H_
#define DPE_TOOLS_EXPERIMENTS_REQUIREMENTS_INSTRUCTION_COUNT_H_

#include <string>
#include <utility>
#include <vector>

namespace dpe::experiments {

// What an instruction count says of one run.
//
// The C library is left out: what malloc has to do depends on all that was allocated
// and freed before, and memset on where memory lies. The same work then takes the same
// count but for rounding, which may change where an iteration ends.
struct InstructionCount {
  double total = 0.0;
  // Name and own instructions (those of callees excluded) of each function.
  std::vector<std::pair<std::string, double>> functions;

  // Of the functions whose name contains one of the given texts. What the compiler has
  // inlined elsewhere counts there.
  double In(const std::vector<std::string>& parts_of_names) const;
};

// Whether instructions can be counted here.
// @param why  receives the reason if not; may be null
bool CanCountInstructions(std::string* why = nullptr);

// @param command    program and arguments, see RunTimed
// @param functions  what is counted, as valgrind's --toggle-collect takes it:
//                   "dpe::Estimate(*". One must not call another of them, which would
//                   turn the counting off.
// @throws std::runtime_error with a reason if nothing can be counted here, the program
//         ends by a signal or with another exit code than 0 and 2 (the limit of
//         iterations), or none of the functions is called
InstructionCount CountInstructions(const std::vector<std::string>& command,
                                   const std::vector<std::string>& functions);

// The instructions in the output of callgrind_annotate --threshold=100.
InstructionCount ParseAnnotation(const std::string& annotation);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_REQUIREMENTS_INSTRUCTION_COUNT_H_
