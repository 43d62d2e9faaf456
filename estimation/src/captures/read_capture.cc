#include <string_view>

#include "captures/readers.h"
#include "captures/text.h"
#include "dpe/engine/scene.h"
#include "dpe/estimation/capture.h"

namespace dpe {
namespace {

constexpr std::string_view kNpyMagic = "\x93NUMPY";
constexpr std::string_view kPc2Magic("POINTCACHE2\0", 12);

bool StartsWith(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

// The first word of the first line that is neither empty nor a comment.
std::string_view FirstWord(std::string_view content) {
  LineReader lines(content);
  std::string_view line;
  while (lines.Next(&line)) {
    line = Trim(line);
    if (line.empty() || line.front() == '#') continue;
    return line.substr(0, line.find_first_of(" \t"));
  }
  return {};
}

bool IsObjKeyword(std::string_view word) {
  for (const char* keyword :
       {"v", "vt", "vn", "o", "g", "s", "f", "mtllib", "usemtl"}) {
    if (word == keyword) return true;
  }
  return false;
}

}  // namespace

Capture ReadCapture(const std::string& path, const CaptureOptions& options) {
  if (IsSequenceName(path)) return ReadObjSequence(path, FindSequence(path));
  const std::string content = ReadWholeFile(path);
  if (StartsWith(content, kNpyMagic)) return ReadNpyCapture(path, content, options);
  if (StartsWith(content, kPc2Magic)) return ReadPc2Capture(path, content, options);
  const std::string_view word = FirstWord(content);
  if (word == "PathFileType") return ReadTrcCapture(path, content, options);
  if (IsObjKeyword(word)) return ReadObjSequence(path, {{path, 0}});
  // A file that is none of these is most often a CSV file with another header.
  return ReadCsvCapture(path, content, options);
}

}  // namespace dpe
