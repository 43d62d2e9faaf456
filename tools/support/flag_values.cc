#include "support/flag_values.h"

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "dpe/engine/scene.h"

namespace dpe::tools {
namespace {

[[noreturn]] void Fail(const std::string& flag, const std::string& text,
                       const std::string& accepted) {
  throw SceneError("--" + flag + ": \"" + text + "\" is not accepted; expected " +
                   accepted);
}

bool ParseNumber(const std::string& text, double* number) {
  if (text.empty() || std::isspace(static_cast<unsigned char>(text.front()))) {
    return false;
  }
  char* end = nullptr;
  *number = std::strtod(text.c_str(), &end);
  return *end == '\0' && std::isfinite(*number);
}

}  // namespace

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  if (text.empty()) return parts;
  size_t begin = 0;
  for (size_t end; (end = text.find(separator, begin)) != std::string::npos;) {
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  parts.push_back(text.substr(begin));
  return parts;
}

std::vector<double> ParseNumbers(const std::string& flag, const std::string& text,
                                 int count) {
  const std::string accepted =
      (count < 0 ? "finite numbers" : std::to_string(count) + " finite numbers") +
      std::string(" separated by commas, without spaces");
  std::vector<double> numbers;
  for (const std::string& part : Split(text, ',')) {
    double number = 0.0;
    if (!ParseNumber(part, &number)) Fail(flag, text, accepted);
    numbers.push_back(number);
  }
  if (count >= 0 && static_cast<int>(numbers.size()) != count) {
    Fail(flag, text, accepted);
  }
  return numbers;
}

Eigen::Vector3d ParseVector3(const std::string& flag, const std::string& text) {
  const std::vector<double> numbers = ParseNumbers(flag, text, 3);
  return {numbers[0], numbers[1], numbers[2]};
}

std::vector<int> ParseIndices(const std::string& flag, const std::string& text) {
  std::vector<int> indices;
  for (double number : ParseNumbers(flag, text, -1)) {
    if (number < 0.0 || number > std::numeric_limits<int>::max() ||
        number != std::floor(number)) {
      Fail(flag, text, "whole numbers >= 0 separated by commas");
    }
    indices.push_back(static_cast<int>(number));
  }
  return indices;
}

void RequireFlag(const std::string& flag, const std::string& value,
                 const std::string& meaning) {
  if (value.empty()) {
    throw SceneError("--" + flag + " is missing: " + meaning + " (see --help)");
  }
}

}  // namespace dpe::tools
