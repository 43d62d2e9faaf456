// Flags that hold several paths: given several times, or with commas, or both.
#ifndef DPE_TOOLS_SUPPORT_REPEATED_FLAG_H_
#define DPE_TOOLS_SUPPORT_REPEATED_FLAG_H_

#include <string>
#include <vector>

namespace dpe::tools {

// Of a flag that is given twice, gflags keeps the last value only; but it asks a
// validator about each. This one accepts and remembers them all:
//
//   DEFINE_string(target, "", "...");
//   DEFINE_validator(target, &dpe::tools::RememberValue);
bool RememberValue(const char* flag, const std::string& value);

// The paths of all values of such a flag, in their order; none if it was not given or
// is empty. A value is split at its commas, unless it is the path of something that
// exists, or a pattern (with * or ?) of which not every part is a pattern or exists.
// @throws SceneError if one of several paths is empty
std::vector<std::string> RepeatedPaths(const std::string& flag);

}  // namespace dpe::tools

#endif  // DPE_TOOLS_SUPPORT_REPEATED_FLAG_H_
