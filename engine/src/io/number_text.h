// Numbers as text that reads back to the same bits.
#ifndef DPE_ENGINE_SRC_IO_NUMBER_TEXT_H_
#define DPE_ENGINE_SRC_IO_NUMBER_TEXT_H_

#include <charconv>
#include <cmath>
#include <string>

namespace dpe {

// The shortest decimal text that reads back as `value`: "0.1", "-0.0", "1e+300". Always
// recognisable as a floating point number, so that the sign of -0.0 survives in JSON.
inline std::string NumberText(double value) {
  char buffer[32];
  const auto result = std::to_chars(buffer, buffer + sizeof(buffer), value);
  std::string text(buffer, result.ptr);
  if (std::isfinite(value) && text.find_first_of(".e") == std::string::npos) {
    text += ".0";
  }
  return text;
}

}  // namespace dpe

#endif  // DPE_ENGINE_SRC_IO_NUMBER_TEXT_H_
