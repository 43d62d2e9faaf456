#include "captures/text.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "dpe/engine/scene.h"

namespace dpe {

void FailAtLine(const std::string& path, int line, const std::string& what) {
  throw SceneError(path + ":" + std::to_string(line) + ": " + what);
}

std::string ReadWholeFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw SceneError(path + ": cannot be opened for reading");
  std::string content;
  char buffer[1 << 16];
  while (file.read(buffer, sizeof(buffer)) || file.gcount() > 0) {
    content.append(buffer, static_cast<size_t>(file.gcount()));
  }
  if (file.bad()) throw SceneError(path + ": cannot be read");
  return content;
}

std::string_view Trim(std::string_view text) {
  const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

std::string Excerpt(std::string_view text) {
  std::string excerpt(text.substr(0, 60));
  // Binary files are taken for text when nothing else fits.
  for (char& c : excerpt) {
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
  }
  return excerpt;
}

int ParseIndex(std::string_view field, const char* name, int limit,
               const std::string& path, int line) {
  int value = -1;
  if (!ParseNumber(field, &value) || value < 0 || value >= limit) {
    FailAtLine(path, line,
               std::string(name) + " is '" + Excerpt(field) +
                   "'; accepted is an integer from 0 to " + std::to_string(limit - 1));
  }
  return value;
}

double ParseFinite(std::string_view field, const std::string& name,
                   const char* accepted, const std::string& path, int line) {
  double value = 0.0;
  if (!ParseNumber(field, &value) || !std::isfinite(value)) {
    FailAtLine(path, line,
               name + " is '" + Excerpt(field) + "'; accepted is " + accepted);
  }
  return value;
}

bool ParsePosition(const std::string_view* fields, bool nan_is_missing,
                   const std::string& path, int line, double* xyz) {
  bool finite = true;
  int num_nan = 0;
  for (int c = 0; c < 3; ++c) {
    const bool is_number = ParseNumber(fields[c], &xyz[c]);
    finite &= is_number && std::isfinite(xyz[c]);
    num_nan += is_number && std::isnan(xyz[c]) ? 1 : 0;
  }
  if (finite) return true;
  if (nan_is_missing && num_nan == 3) return false;
  const char* accepted =
      num_nan == 0 ? "a finite number"
                   : "a finite number; where a point was not seen leave the row out, "
                     "or say that three nan mean that";
  for (int c = 0; c < 3; ++c) {
    ParseFinite(fields[c], std::string(1, "xyz"[c]), accepted, path, line);
  }
  return true;
}

void SplitFields(std::string_view text, char separator,
                 std::vector<std::string_view>* fields) {
  fields->clear();
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(separator, begin), text.size());
    fields->push_back(Trim(text.substr(begin, end - begin)));
    begin = end + 1;
  }
}

void SplitWords(std::string_view text, std::vector<std::string_view>* words) {
  constexpr char kSpace[] = " \t\r";
  words->clear();
  size_t begin = text.find_first_not_of(kSpace);
  while (begin != std::string_view::npos) {
    const size_t end = std::min(text.find_first_of(kSpace, begin), text.size());
    words->push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(kSpace, end);
  }
}

void AppendNumber(double value, std::string* text) {
  char buffer[40];
  const auto result = std::to_chars(buffer, buffer + sizeof(buffer), value);
  text->append(buffer, result.ptr);
}

bool LineReader::Next(std::string_view* line) {
  if (rest_.empty()) return false;
  size_t end = std::min(rest_.find('\n'), rest_.size());
  size_t next = end + 1;
  // A lone carriage return ends a line too: old exporters write them.
  const size_t cr = rest_.substr(0, end).find('\r');
  if (cr != std::string_view::npos) {
    if (cr + 1 < end || end == rest_.size()) next = cr + 1;
    end = cr;
  }
  *line = rest_.substr(0, end);
  rest_.remove_prefix(std::min(next, rest_.size()));
  ++number_;
  return true;
}

}  // namespace dpe
