// Lines, fields and numbers of text files, with messages that say where.
#ifndef DPE_ESTIMATION_SRC_CAPTURES_TEXT_H_
#define DPE_ESTIMATION_SRC_CAPTURES_TEXT_H_

#include <charconv>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace dpe {

// Beyond this a frame number is taken for a mistake rather than for a reason to
// allocate memory.
constexpr int kMaxFrame = 10'000'000;

// "FILE:LINE: what", as a SceneError.
[[noreturn]] void FailAtLine(const std::string& path, int line,
                             const std::string& what);

// The whole file. @throws SceneError if it cannot be read
std::string ReadWholeFile(const std::string& path);

// Without white space at both ends.
std::string_view Trim(std::string_view text);

// At most 60 characters of it, for a message, control characters replaced.
std::string Excerpt(std::string_view text);

// The number that fills all of `field`; false if it does not.
template <typename Number>
bool ParseNumber(std::string_view field, Number* value) {
  if (!field.empty() && field.front() == '+') field.remove_prefix(1);
  const char* end = field.data() + field.size();
  const auto [stop, error] = std::from_chars(field.data(), end, *value);
  return error == std::errc() && stop == end;
}

// A whole number from 0 to limit - 1.
int ParseIndex(std::string_view field, const char* name, int limit,
               const std::string& path, int line);

// A finite number. @param accepted  "a finite number"
double ParseFinite(std::string_view field, const std::string& name,
                   const char* accepted, const std::string& path, int line);

// Three finite coordinates; false if all are NaN and that means "not seen".
bool ParsePosition(const std::string_view* fields, bool nan_is_missing,
                   const std::string& path, int line, double* xyz);

// Splits at each separator; fields are trimmed.
void SplitFields(std::string_view text, char separator,
                 std::vector<std::string_view>* fields);

// Splits at white space; there are no empty fields.
void SplitWords(std::string_view text, std::vector<std::string_view>* words);

// The shortest text that reads back to the same double.
void AppendNumber(double value, std::string* text);

inline std::string NumberField(double value) {
  std::string text;
  AppendNumber(value, &text);
  return text;
}

// Reads a text line by line, without copies.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}
  // False at the end. Line breaks of any system are taken off.
  bool Next(std::string_view* line);
  int number() const { return number_; }  // of the last line, from 1

 private:
  std::string_view rest_;
  int number_ = 0;
};

}  // namespace dpe

#endif  // DPE_ESTIMATION_SRC_CAPTURES_TEXT_H_
