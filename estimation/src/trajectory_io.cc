#include "dpe/estimation/trajectory_io.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "captures/readers.h"
#include "captures/text.h"
#include "captures/writers.h"
#include "dpe/engine/scene_io.h"
#include "dpe/estimation/attach.h"
#include "dpe/estimation/capture.h"

namespace dpe {
namespace {

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

bool EndsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() &&
         text.compare(text.size() - end.size(), end.size(), end) == 0;
}

TrajectoryFormat FormatOf(const std::string& path, TrajectoryFormat format) {
  if (format != TrajectoryFormat::kAuto) return format;
  if (EndsWith(path, ".obj")) return TrajectoryFormat::kObj;
  if (EndsWith(path, ".pc2")) return TrajectoryFormat::kPc2;
  if (EndsWith(path, ".npy")) return TrajectoryFormat::kNpy;
  return TrajectoryFormat::kCsv;
}

std::vector<std::string> WriteObjSequence(const std::string& pattern,
                                          const PointFrames& points, int num_frames,
                                          const Scene& scene) {
  CheckObjPattern(pattern, num_frames);
  const std::filesystem::path folder = std::filesystem::path(pattern).parent_path();
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error) {
    throw SceneError(folder.string() + ": cannot be created: " + error.message());
  }
  std::vector<std::string> files;
  for (int f = 0; f < points.num_frames; ++f) {
    files.push_back(ObjFrameName(pattern, f));
    WriteFileAtomically(files.back(), FrameToObj(points, scene, f));
  }
  // Of an earlier run: whoever reads the pattern would take them for this one's.
  for (int f = points.num_frames; f < num_frames; ++f) {
    std::filesystem::remove(ObjFrameName(pattern, f), error);
  }
  return files;
}

}  // namespace

Observations ReadTrajectoryCsv(const std::string& path, const Scene& scene,
                               int num_frames) {
  Capture capture = ReadCsvCapture(path, ReadWholeFile(path), {});
  ToSceneUnits({}, scene.delta, &capture);
  Observations observations = AttachCapture(capture, scene);
  for (auto* matrices : {&observations.positions, &observations.sigmas}) {
    for (Eigen::MatrixXd& m : *matrices) {
      if (num_frames > 0 && m.cols() > num_frames) {
        m = m.leftCols(num_frames).eval();
      }
    }
  }
  return observations;
}

std::string TrajectoryToCsv(const Trajectory& trajectory, const Scene& scene) {
  std::string text = "frame,vertex,x,y,z\n";
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

TrajectoryFormat TrajectoryFormatFromName(const std::string& name) {
  if (name == "auto") return TrajectoryFormat::kAuto;
  if (name == "csv") return TrajectoryFormat::kCsv;
  if (name == "obj") return TrajectoryFormat::kObj;
  if (name == "pc2") return TrajectoryFormat::kPc2;
  if (name == "npy") return TrajectoryFormat::kNpy;
  throw SceneError("format: \"" + name +
                   "\" is not accepted; expected auto, csv, obj, pc2 or npy");
}

void CheckTrajectoryOutput(const std::string& path, TrajectoryFormat format,
                           int num_frames) {
  if (FormatOf(path, format) == TrajectoryFormat::kObj) {
    CheckObjPattern(path, num_frames);
  }
}

std::vector<std::string> WriteTrajectory(const std::string& path,
                                         TrajectoryFormat format,
                                         const Trajectory& trajectory,
                                         const Scene& scene) {
  format = FormatOf(path, format);
  if (format == TrajectoryFormat::kCsv) {
    WriteFileAtomically(path, TrajectoryToCsv(trajectory, scene));
    return {path};
  }
  const PointFrames points = WholeFrames(trajectory);
  if (points.num_frames == 0) {
    throw SceneError(path + ": there is no whole frame to write");
  }
  if (format == TrajectoryFormat::kObj) {
    return WriteObjSequence(path, points, trajectory.num_frames(), scene);
  }
  WriteFileAtomically(path, format == TrajectoryFormat::kPc2 ? PointsToPc2(points)
                                                             : PointsToNpy(points));
  return {path};
}

}  // namespace dpe
