// Where a job's results go, and writing them.
#include <cmath>
#include <filesystem>
#include <system_error>

#include "dpe/engine/scene_io.h"
#include "dpe/estimation/estimation_job.h"
#include "dpe/estimation/report_io.h"

namespace dpe {
namespace {

// @param which  "" of a job's only capture, "_2" of the second of several
std::string TrajectoryPath(const EstimationJob& job, const std::string& output_dir,
                           const std::string& which) {
  const std::string path = output_dir + "/trajectory" + which;
  switch (job.trajectory_format) {
    case TrajectoryFormat::kObj:
      return path + "_*.obj";
    case TrajectoryFormat::kPc2:
      return path + ".pc2";
    case TrajectoryFormat::kNpy:
      return path + ".npy";
    case TrajectoryFormat::kAuto:
    case TrajectoryFormat::kCsv:
      break;
  }
  return path + ".csv";
}

}  // namespace

namespace {

std::string NameWith(const EstimationJob& job, const std::string& settings) {
  std::vector<std::string> paths =
      job.scene_paths.empty() ? job.target_paths : job.scene_paths;
  if (!job.scenes.empty()) paths.assign(job.scenes.size(), "scene");
  std::string name = std::filesystem::path(paths[0]).stem().string();
  if (paths.size() > 1) name += "_and_" + std::to_string(paths.size() - 1) + "_more";
  return name + "_" + settings;
}

}  // namespace

std::string JobName(const EstimationJob& job, const EstimationInput& input) {
  return NameWith(job, SettingsString(input.captures[0].scene));
}

std::string PrepareOutputDir(const EstimationJob& job, const EstimationInput& input) {
  const std::string name =
      input.auto_objects.empty() ? JobName(job, input) : NameWith(job, job.settings);
  const std::string dir = job.output_dir.empty() ? "results/" + name : job.output_dir;
  std::error_code error;
  std::filesystem::create_directories(dir, error);
  if (error || !std::filesystem::is_directory(dir, error)) {
    throw SceneError("--output_dir: " + dir + " cannot be created" +
                     (error ? ": " + error.message() : ": it is not a folder"));
  }
  return dir;
}

std::vector<std::string> WriteResults(const EstimationJob& job,
                                      const EstimationInput& input,
                                      const EstimatorSummary& summary,
                                      const std::vector<Validation>& validations,
                                      const std::string& output_dir,
                                      const ModelSelection* selection) {
  std::vector<std::string> files;
  const bool has_result = std::isfinite(summary.final_cost);
  const bool are_several = validations.size() > 1;
  for (size_t c = 0; has_result && c < validations.size(); ++c) {
    const Scene& scene = summary.captures[c].scene;
    const std::string which = are_several ? "_" + std::to_string(c + 1) : "";
    const std::string scene_name =
        are_several ? "scene" + which : JobName(job, input) + "_optimized";
    files.push_back(output_dir + "/" + scene_name + ".txt");
    SaveScene(scene, files.back());
    const std::vector<std::string> frames =
        WriteTrajectory(TrajectoryPath(job, output_dir, which), job.trajectory_format,
                        validations[c].trajectory, scene);
    files.insert(files.end(), frames.begin(), frames.end());
  }
  files.push_back(output_dir + "/report.json");
  WriteFileAtomically(files.back(),
                      ReportToJson(job, input, summary, validations, selection));
  return files;
}

}  // namespace dpe
