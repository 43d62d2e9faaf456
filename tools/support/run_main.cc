#include "support/run_main.h"

#include <gflags/gflags.h>

#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>
#include <sstream>
#include <vector>

#include "dpe/engine/scene.h"

namespace dpe::tools {
namespace {

int PrintError(const Program& program, const std::string& message) {
  std::cout.flush();
  std::cerr << program.name << ": error: " << message << std::endl;
  return 1;
}

std::string Folder(const std::string& file) {
  return file.substr(0, file.find_last_of('/') + 1);
}

// The libraries we link define flags of their own (gflags some, glog dozens). The flags
// of a program are those in its source file and in or below this folder.
bool IsOwnFlag(const Program& program, const gflags::CommandLineFlagInfo& flag) {
  return flag.filename == program.source_file ||
         flag.filename.rfind(Folder(__FILE__), 0) == 0;
}

std::string Wrap(const std::string& text, const std::string& indent, size_t width) {
  std::istringstream words(text);
  std::string result, line = indent, word;
  while (words >> word) {
    if (line.size() > indent.size() && line.size() + 1 + word.size() > width) {
      result += line + "\n";
      line = indent;
    }
    if (line.size() > indent.size()) line += ' ';
    line += word;
  }
  return result + line + "\n";
}

// "0.1" rather than the 17 digits that gflags gives.
std::string DefaultText(const gflags::CommandLineFlagInfo& flag) {
  if (flag.type == "string") {
    return flag.default_value.empty() ? "" : ", default \"" + flag.default_value + '"';
  }
  std::ostringstream text;
  text << ", default ";
  if (flag.type == "double") {
    text << std::strtod(flag.default_value.c_str(), nullptr);
  } else {
    text << flag.default_value;
  }
  return text.str();
}

void PrintHelp(const Program& program) {
  std::cout << Wrap(program.summary, "", 80) << "\nUsage: "
            << Wrap(program.name + " " + program.usage, "       ", 80).substr(7)
            << "\nFlags:\n";
  std::vector<gflags::CommandLineFlagInfo> flags;
  gflags::GetAllFlags(&flags);
  for (const gflags::CommandLineFlagInfo& flag : flags) {
    if (!IsOwnFlag(program, flag)) continue;
    std::cout << "  --" << flag.name << " (" << flag.type << DefaultText(flag) << ")\n"
              << Wrap(flag.description, "      ", 80);
  }
}

bool IsSet(const char* flag) {
  std::string value;
  return gflags::GetCommandLineOption(flag, &value) && value == "true";
}

}  // namespace

int RunMain(int argc, char** argv, const Program& program,
            const std::function<int()>& body) {
  // What Ceres has to say the program says itself; its log would only add that a step
  // failed that was stopped on purpose.
  gflags::SetCommandLineOptionWithMode("minloglevel", "3", gflags::SET_FLAGS_DEFAULT);
  gflags::ParseCommandLineNonHelpFlags(&argc, &argv, /*remove_flags=*/true);
  if (IsSet("help") || IsSet("helpshort")) {
    PrintHelp(program);
    return 0;
  }
  gflags::HandleCommandLineHelpFlags();  // --helpfull, --version, ...: exits if given
  int num_arguments = 0;
  if (program.argument != nullptr && argc > 1) {
    *program.argument = argv[1];
    num_arguments = 1;
  }
  if (argc > 1 + num_arguments) {
    const char* extra = argv[1 + num_arguments];
    if (num_arguments > 0) {
      return PrintError(program, "\"" + std::string(extra) + "\" follows \"" +
                                     *program.argument +
                                     "\"; one argument that is not a flag is accepted "
                                     "(see --help)");
    }
    return PrintError(program, "\"" + std::string(extra) +
                                   "\" is not a flag; every argument is of the form "
                                   "--flag=value (see --help)");
  }
  try {
    const int code = body();
    std::cout.flush();
    return code != 0 || std::cout.good()
               ? code
               : PrintError(program, "cannot write to stdout");
  } catch (const std::bad_alloc&) {
    return PrintError(program, "not enough memory");
  } catch (const std::exception& error) {
    return PrintError(program, error.what());
  }
}

bool FlagIsGiven(const std::string& flag) {
  return !gflags::GetCommandLineFlagInfoOrDie(flag.c_str()).is_default;
}

}  // namespace dpe::tools
