#include <string_view>

#include "captures/text.h"
#include "dpe/estimation/attach.h"

namespace dpe {

std::map<std::string, int> ReadMarkerMap(const std::string& path) {
  const std::string content = ReadWholeFile(path);
  std::map<std::string, int> vertex_of;
  std::map<int, std::string> marker_of;
  LineReader lines(content);
  std::string_view line;
  std::vector<std::string_view> fields;
  bool header_seen = false;
  while (lines.Next(&line)) {
    if (Trim(line).empty()) continue;
    SplitFields(line, ',', &fields);
    if (fields.size() != 2) {
      FailAtLine(path, lines.number(),
                 "has " + std::to_string(fields.size()) +
                     " fields; accepted are the two of 'marker,vertex'");
    }
    if (!header_seen) {
      if (fields[0] != "marker" || fields[1] != "vertex") {
        FailAtLine(
            path, lines.number(),
            "the header is '" + Excerpt(line) + "'; accepted is 'marker,vertex'");
      }
      header_seen = true;
      continue;
    }
    const std::string name(fields[0]);
    const int vertex = ParseIndex(fields[1], "vertex", kMaxFrame, path, lines.number());
    if (!vertex_of.emplace(name, vertex).second) {
      FailAtLine(path, lines.number(), "marker '" + name + "' is there twice");
    }
    const auto [other, is_new] = marker_of.emplace(vertex, name);
    if (!is_new) {
      FailAtLine(path, lines.number(),
                 "vertex " + std::to_string(vertex) + " is marker '" + other->second +
                     "' already");
    }
  }
  if (vertex_of.empty()) {
    throw SceneError(path +
                     ": has no data; accepted is a line 'marker,vertex' and one line "
                     "per marker");
  }
  return vertex_of;
}

}  // namespace dpe
