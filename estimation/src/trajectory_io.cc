#include "dpe/estimation/trajectory_io.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string_view>
#include <system_error>
#include <vector>

namespace dpe {
namespace {

constexpr char kHeader[] = "frame,vertex,x,y,z";

// Beyond this a frame number is taken for a mistake rather than for a reason to
// allocate memory.
constexpr int kMaxFrame = 10'000'000;

struct Row {
  int frame = 0;
  int vertex = 0;
  double position[3] = {0.0, 0.0, 0.0};
  int line = 0;
};

[[noreturn]] void Fail(const std::string& path, int line, const std::string& what) {
  throw SceneError(path + ":" + std::to_string(line) + ": " + what);
}

std::string_view Trim(std::string_view text) {
  const size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string ReadAll(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw SceneError(path + ": cannot be opened for reading");
  std::ostringstream content;
  content << file.rdbuf();
  // An empty file sets failbit on the stream it is copied to, which is no error here.
  if (file.bad()) throw SceneError(path + ": cannot be read");
  return content.str();
}

// The number that fills all of `field`; false if it does not.
template <typename Number>
bool ParseNumber(std::string_view field, Number* value) {
  if (!field.empty() && field.front() == '+') field.remove_prefix(1);
  const char* end = field.data() + field.size();
  const auto [stop, error] = std::from_chars(field.data(), end, *value);
  return error == std::errc() && stop == end;
}

int ParseIndex(std::string_view field, const char* name, int limit,
               const std::string& path, int line) {
  int value = -1;
  if (!ParseNumber(field, &value) || value < 0 || value >= limit) {
    Fail(path, line,
         std::string(name) + " is '" + std::string(field) +
             "'; accepted is an integer from 0 to " + std::to_string(limit - 1));
  }
  return value;
}

Row ParseRow(std::string_view text, int num_vertices, const std::string& path,
             int line) {
  std::string_view fields[5];
  int num_fields = 0;
  for (size_t begin = 0; begin <= text.size(); ++num_fields) {
    const size_t comma = std::min(text.find(',', begin), text.size());
    if (num_fields < 5) fields[num_fields] = Trim(text.substr(begin, comma - begin));
    begin = comma + 1;
  }
  if (num_fields != 5) {
    Fail(path, line,
         "has " + std::to_string(num_fields) + " fields; accepted are the five of '" +
             kHeader + "'");
  }
  Row row;
  row.line = line;
  row.frame = ParseIndex(fields[0], "frame", kMaxFrame, path, line);
  row.vertex = ParseIndex(fields[1], "vertex", num_vertices, path, line);
  for (int c = 0; c < 3; ++c) {
    if (!ParseNumber(fields[2 + c], &row.position[c]) ||
        !std::isfinite(row.position[c])) {
      Fail(path, line,
           std::string(1, "xyz"[c]) + " is '" + std::string(fields[2 + c]) +
               "'; accepted is a finite number (m)");
    }
  }
  return row;
}

std::vector<Row> ParseRows(const std::string& content, int num_vertices,
                           const std::string& path) {
  std::vector<Row> rows;
  bool header_seen = false;
  int line = 0;
  for (size_t begin = 0; begin < content.size();) {
    const size_t end = std::min(content.find('\n', begin), content.size());
    const std::string_view text =
        Trim(std::string_view(content).substr(begin, end - begin));
    begin = end + 1;
    ++line;
    if (text.empty()) continue;
    if (!header_seen) {
      if (text != kHeader) {
        Fail(path, line,
             "the header is '" + std::string(text.substr(0, 60)) + "'; accepted is '" +
                 kHeader + "'");
      }
      header_seen = true;
      continue;
    }
    rows.push_back(ParseRow(text, num_vertices, path, line));
  }
  if (rows.empty()) {
    throw SceneError(path + ": has no data; accepted is a line '" + kHeader +
                     "' and one line per observed vertex and frame");
  }
  return rows;
}

// Object and vertex within it of every vertex of the scene.
std::vector<std::pair<int, int>> VertexOwners(const Scene& scene) {
  std::vector<std::pair<int, int>> owners;
  for (int object = 0; object < static_cast<int>(scene.objects.size()); ++object) {
    for (int v = 0; v < scene.objects[object].num_vertices(); ++v) {
      owners.emplace_back(object, v);
    }
  }
  return owners;
}

void AppendNumber(double value, std::string* text) {
  char buffer[40];
  // The shortest text that reads back to the same double.
  const auto result = std::to_chars(buffer, buffer + sizeof(buffer), value);
  text->append(buffer, result.ptr);
}

}  // namespace

Observations ReadTrajectoryCsv(const std::string& path, const Scene& scene,
                               int num_frames) {
  const std::vector<std::pair<int, int>> owners = VertexOwners(scene);
  const std::string content = ReadAll(path);
  const std::vector<Row> rows =
      ParseRows(content, static_cast<int>(owners.size()), path);
  int frames_in_file = 0;
  for (const Row& row : rows) frames_in_file = std::max(frames_in_file, row.frame + 1);
  const int frames =
      num_frames > 0 ? std::min(num_frames, frames_in_file) : frames_in_file;

  // More than this per row present is a typing error in a frame number.
  if (static_cast<size_t>(frames) > 1000 * rows.size() + 1000) {
    throw SceneError(path + ": the last frame is " +
                     std::to_string(frames_in_file - 1) + " but there are only " +
                     std::to_string(rows.size()) + " rows");
  }
  Observations observations;
  observations.positions.resize(scene.objects.size());
  std::vector<int> first_line(owners.size() * static_cast<size_t>(frames), 0);
  for (const Row& row : rows) {
    if (row.frame >= frames) continue;
    int& seen = first_line[static_cast<size_t>(row.frame) * owners.size() + row.vertex];
    if (seen != 0) {
      Fail(path, row.line,
           "frame " + std::to_string(row.frame) + ", vertex " +
               std::to_string(row.vertex) + " was given before, in line " +
               std::to_string(seen));
    }
    seen = row.line;
    const auto [object, vertex] = owners[row.vertex];
    Eigen::MatrixXd& positions = observations.positions[object];
    if (positions.size() == 0) {
      positions =
          Eigen::MatrixXd::Constant(3 * scene.objects[object].num_vertices(), frames,
                                    std::numeric_limits<double>::quiet_NaN());
    }
    positions.col(row.frame).segment<3>(3 * vertex) =
        Eigen::Map<const Eigen::Vector3d>(row.position);
  }
  return observations;
}

std::string TrajectoryToCsv(const Trajectory& trajectory, const Scene& scene) {
  std::string text = std::string(kHeader) + "\n";
  const std::vector<std::pair<int, int>> owners = VertexOwners(scene);
  for (int f = 0; f < trajectory.num_frames(); ++f) {
    for (size_t vertex = 0; vertex < owners.size(); ++vertex) {
      const auto [object, v] = owners[vertex];
      const Eigen::MatrixXd& positions = trajectory.positions[object];
      // A row without a number would be refused by the reader: a frame that the rollout
      // did not reach is missing data.
      if (f >= positions.cols() || !positions.col(f).segment<3>(3 * v).allFinite()) {
        continue;
      }
      text += std::to_string(f) + ',' + std::to_string(vertex);
      for (int c = 0; c < 3; ++c) {
        text += ',';
        AppendNumber(positions(3 * v + c, f), &text);
      }
      text += '\n';
    }
  }
  return text;
}

}  // namespace dpe
