// Values of flags that are more than one number. All throw SceneError naming the flag,
// its value and what is accepted.
#ifndef DPE_TOOLS_SUPPORT_FLAG_VALUES_H_
#define DPE_TOOLS_SUPPORT_FLAG_VALUES_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "dpe/engine/scene.h"

namespace dpe::tools {

// "a;b;c" -> {"a", "b", "c"}; an empty text has no parts.
std::vector<std::string> Split(const std::string& text, char separator);

// Finite numbers separated by commas.
// @param flag   name without dashes, for messages
// @param count  how many are expected; negative: any number of them
std::vector<double> ParseNumbers(const std::string& flag, const std::string& text,
                                 int count);

// "x,y,z"
Eigen::Vector3d ParseVector3(const std::string& flag, const std::string& text);

// Whole numbers >= 0 separated by commas.
std::vector<int> ParseIndices(const std::string& flag, const std::string& text);

// Throws if a flag that the program cannot do without is empty.
// @param meaning  "the scene file to write"
void RequireFlag(const std::string& flag, const std::string& value,
                 const std::string& meaning);

// What `read` makes of a flag's value; its error is made to name the flag.
template <typename Function>
auto FromFlag(const std::string& flag, const std::string& value, Function read) {
  try {
    return read(value);
  } catch (const SceneError& error) {
    throw SceneError("--" + flag + ": " + error.what());
  }
}

}  // namespace dpe::tools

#endif  // DPE_TOOLS_SUPPORT_FLAG_VALUES_H_
