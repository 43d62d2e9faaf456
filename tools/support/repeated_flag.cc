#include "support/repeated_flag.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <system_error>

#include "dpe/engine/scene.h"
#include "support/flag_values.h"

namespace dpe::tools {
namespace {

std::map<std::string, std::vector<std::string>>& Values() {
  static auto* values = new std::map<std::string, std::vector<std::string>>();
  return *values;
}

bool Exists(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

bool IsPattern(const std::string& path) {
  return path.find_first_of("*?") != std::string::npos;
}

std::vector<std::string> SplitPaths(const std::string& value) {
  if (Exists(value)) return {value};
  const std::vector<std::string> parts = Split(value, ',');
  const bool are_paths = std::all_of(
      parts.begin(), parts.end(),
      [](const std::string& part) { return IsPattern(part) || Exists(part); });
  if (IsPattern(value) && !are_paths) return {value};
  return parts;
}

}  // namespace

bool RememberValue(const char* flag, const std::string& value) {
  Values()[flag].push_back(value);
  return true;
}

std::vector<std::string> RepeatedPaths(const std::string& flag) {
  const std::vector<std::string>& values = Values()[flag];
  // Also what a flag that was not given holds.
  if (values.size() <= 1 && (values.empty() || values[0].empty())) return {};
  std::vector<std::string> paths;
  for (const std::string& value : values) {
    const std::vector<std::string> some =
        value.empty() ? std::vector<std::string>{""} : SplitPaths(value);
    paths.insert(paths.end(), some.begin(), some.end());
  }
  if (std::find(paths.begin(), paths.end(), "") != paths.end()) {
    throw SceneError("--" + flag + ": one of its " + std::to_string(paths.size()) +
                     " paths is empty; give --" + flag +
                     " once for each, or all of them separated by commas");
  }
  return paths;
}

}  // namespace dpe::tools
