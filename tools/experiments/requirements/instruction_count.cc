#include "experiments/requirements/instruction_count.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "experiments/requirements/timed_program.h"

namespace dpe::experiments {
namespace {

// GCC and Clang name sanitizers in different ways. Valgrind runs no program that one
// has instrumented, and what is built beside this file is built as this file is.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define DPE_IS_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define DPE_IS_SANITIZED 1
#endif
#endif
#ifndef DPE_IS_SANITIZED
#define DPE_IS_SANITIZED 0
#endif

bool Starts(const char* program) {
  try {
    // callgrind_annotate says its version and returns 255.
    return RunTimed({program, "--version"}).exit_code >= 0;
  } catch (const std::runtime_error&) {
    return false;
  }
}

}  // namespace

double InstructionCount::In(const std::vector<std::string>& parts_of_names) const {
  double sum = 0.0;
  for (const auto& [name, count] : functions) {
    const auto is_in_name = [&name = name](const std::string& part) {
      return name.find(part) != std::string::npos;
    };
    if (std::any_of(parts_of_names.begin(), parts_of_names.end(), is_in_name)) {
      sum += count;
    }
  }
  return sum;
}

bool CanCountInstructions(std::string* why) {
  std::string reason;
  if (DPE_IS_SANITIZED) {
    reason = "valgrind cannot run programs that are built with sanitizers";
  } else if (!Starts("valgrind") || !Starts("callgrind_annotate")) {
    reason = "valgrind, which counts the instructions, is not installed";
  }
  if (why != nullptr) *why = reason;
  return reason.empty();
}

InstructionCount CountInstructions(const std::vector<std::string>& command,
                                   const std::vector<std::string>& functions) {
  std::string why;
  if (!CanCountInstructions(&why)) throw std::runtime_error(why);
  const ScratchFolder folder;
  const std::string profile = folder.File("profile");
  std::vector<std::string> counted = {"valgrind", "--tool=callgrind",
                                      "--callgrind-out-file=" + profile};
  for (const std::string& function : functions) {
    counted.push_back("--toggle-collect=" + function);
  }
  counted.insert(counted.end(), command.begin(), command.end());
  const TimedResult run = RunTimed(counted);
  if (run.exit_code != 0 && run.exit_code != 2) {
    throw std::runtime_error(command[0] + " under valgrind: exit code " +
                             std::to_string(run.exit_code) + "\n" + run.err);
  }
  const TimedResult annotation =
      RunTimed({"callgrind_annotate", "--threshold=100", profile});
  if (annotation.exit_code != 0) {
    throw std::runtime_error("callgrind_annotate: " + annotation.err);
  }
  const InstructionCount count = ParseAnnotation(annotation.out);
  if (count.total == 0.0) {
    throw std::runtime_error(command[0] + " did not call " + functions[0]);
  }
  return count;
}

// Lines are "1,234 (5.6%)  file:function [library]".
InstructionCount ParseAnnotation(const std::string& annotation) {
  InstructionCount count;
  std::istringstream lines(annotation);
  for (std::string line; std::getline(lines, line);) {
    const size_t end = line.find(" (");
    const size_t name = line.find(')', end == std::string::npos ? 0 : end);
    const size_t colon = line.find(':', name == std::string::npos ? 0 : name);
    if (end == std::string::npos || colon == std::string::npos ||
        line.find("/libc.so") != std::string::npos) {
      continue;
    }
    std::string number = line.substr(0, end);
    number.erase(std::remove(number.begin(), number.end(), ','), number.end());
    if (number.find_first_not_of(" 0123456789") != std::string::npos) continue;
    count.functions.emplace_back(line.substr(colon + 1), std::stod(number));
    count.total += count.functions.back().second;
  }
  return count;
}

}  // namespace dpe::experiments
