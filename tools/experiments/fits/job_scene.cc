#include "experiments/fits/job_scene.h"

#include <cstdlib>
#include <filesystem>

#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/scene_io.h"
#include "support/flag_values.h"

namespace dpe::experiments {
namespace {

namespace fs = std::filesystem;

std::string NewFolder() {
  std::string name = (fs::temp_directory_path() / "dpe_job_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    throw SceneError(name + ": the folder cannot be created");
  }
  return name;
}

}  // namespace

const std::vector<std::string>& JobSceneArguments() {
  static const std::vector<std::string> names = {"scene", "preset", "grid"};
  return names;
}

Scene PresetOf(const Job& job) {
  PresetOptions options;
  options.rows = options.cols = job.Integer("grid", options.rows);
  const auto preset = [&] { return ScenePresetFromName(job.Text("preset", "")); };
  return MakePresetScene(preset(), options);
}

JobScenes::JobScenes(const Job& job, bool is_required) {
  paths_ = tools::Split(job.Text("scene", ""), ',');
  if (!job.Has("preset")) {
    if (paths_.empty() && is_required) {
      throw SceneError(
          "scene: missing; expected a scene file, or preset: side, corners, flag or "
          "flag_no_wind");
    }
    if (job.Has("grid")) {
      throw SceneError("grid: only a preset has one");
    }
    return;
  }
  if (!paths_.empty()) throw SceneError("scene and preset: expected one of them");
  const Scene scene = PresetOf(job);
  folder_ = NewFolder();
  paths_ = {folder_ + "/" + job.Text("preset", "") + ".txt"};
  SaveScene(scene, paths_[0]);
}

JobScenes::~JobScenes() {
  std::error_code ignored;
  if (!folder_.empty()) fs::remove_all(folder_, ignored);
}

}  // namespace dpe::experiments
