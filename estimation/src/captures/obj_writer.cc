#include <filesystem>
#include <set>
#include <system_error>

#include "captures/text.h"
#include "captures/writers.h"
#include "dpe/engine/scene.h"

namespace dpe {
namespace {

namespace fs = std::filesystem;

// The files in the pattern's folder that the pattern's name matches.
std::vector<std::string> ExistingFiles(const fs::path& pattern) {
  const std::string name = pattern.filename().string();
  const size_t star = name.find('*');
  const std::string before = name.substr(0, star), after = name.substr(star + 1);
  std::vector<std::string> found;
  std::error_code error;
  const fs::path folder = pattern.parent_path();
  for (const fs::directory_entry& entry :
       fs::directory_iterator(folder.empty() ? "." : folder, error)) {
    const std::string other = entry.path().filename().string();
    if (other.size() >= before.size() + after.size() &&
        other.compare(0, before.size(), before) == 0 &&
        other.compare(other.size() - after.size(), after.size(), after) == 0) {
      found.push_back(other);
    }
  }
  return found;
}

}  // namespace

std::string FrameToObj(const PointFrames& points, const Scene& scene, int frame) {
  std::string text = "# frame " + std::to_string(frame) + "\n";
  int first_vertex = 1;
  for (size_t k = 0; k < points.objects.size(); ++k) {
    const ClothObject& object = scene.objects[points.objects[k]];
    const Eigen::MatrixXd& positions = *points.positions[k];
    text += "o object" + std::to_string(points.objects[k]) + "\n";
    for (int v = 0; v < positions.rows() / 3; ++v) {
      text += 'v';
      for (int c = 0; c < 3; ++c) {
        text += ' ';
        AppendNumber(positions(3 * v + c, frame), &text);
      }
      text += '\n';
    }
    for (const auto& triangle : object.triangles) {
      text += 'f';
      for (int v : triangle) text += ' ' + std::to_string(first_vertex + v);
      text += '\n';
    }
    first_vertex += static_cast<int>(positions.rows() / 3);
  }
  return text;
}

std::string ObjFrameName(const std::string& pattern, int frame) {
  std::string number = std::to_string(frame);
  if (number.size() < 4) number.insert(0, 4 - number.size(), '0');
  std::string name = pattern;
  return name.replace(name.find('*'), 1, number);
}

void CheckObjPattern(const std::string& pattern, int num_frames) {
  const fs::path path(pattern);
  const size_t star = pattern.find('*');
  if (star == std::string::npos || pattern.find('*', star + 1) != std::string::npos ||
      path.filename().string().find('*') == std::string::npos) {
    throw SceneError(pattern +
                     ": is not accepted for an OBJ sequence; expected a name with one "
                     "'*' for the number of the frame, like frames/cloth_*.obj");
  }
  std::set<std::string> written;
  for (int f = 0; f < num_frames; ++f) {
    written.insert(fs::path(ObjFrameName(pattern, f)).filename().string());
  }
  for (const std::string& name : ExistingFiles(path)) {
    if (written.count(name) > 0) continue;
    throw SceneError(pattern + ": matches " + name +
                     ", which is there and would not be overwritten by " +
                     std::to_string(num_frames) +
                     " frames; expected a pattern that matches nothing else");
  }
}

}  // namespace dpe
