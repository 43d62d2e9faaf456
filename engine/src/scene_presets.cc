#include <utility>

#include "dpe/engine/cloth_builder.h"

namespace dpe {
namespace {

struct PresetTraits {
  ScenePreset preset;
  const char* name;
  GridPlane plane;
  int num_frames;
  bool pins_last_row;    // otherwise the four corners
  Eigen::Vector3d wind;  // m/s
};

const PresetTraits& Traits(ScenePreset preset) {
  static const PresetTraits kTraits[] = {
      {ScenePreset::kSide, "side", GridPlane::kXZ, 100, true, {0.0, 0.0, 0.0}},
      {ScenePreset::kCorners, "corners", GridPlane::kXZ, 100, false, {0.0, 0.0, 0.0}},
      {ScenePreset::kFlag, "flag", GridPlane::kYZ, 20, true, {106.066, 0.0, -106.066}},
      {ScenePreset::kFlagNoWind,
       "flag_no_wind",
       GridPlane::kYZ,
       20,
       true,
       {0.0, 0.0, 0.0}},
  };
  return kTraits[static_cast<int>(preset)];
}

constexpr ScenePreset kAllPresets[] = {ScenePreset::kSide, ScenePreset::kCorners,
                                       ScenePreset::kFlag, ScenePreset::kFlagNoWind};

std::vector<int> PinnedVertices(const PresetTraits& traits, int rows, int cols) {
  const int first_of_last_row = cols * (rows - 1);
  if (!traits.pins_last_row) {
    return {0, cols - 1, first_of_last_row, first_of_last_row + cols - 1};
  }
  std::vector<int> row;
  for (int i = 0; i < cols; ++i) row.push_back(first_of_last_row + i);
  return row;
}

}  // namespace

ScenePreset ScenePresetFromName(const std::string& name) {
  std::string accepted;
  for (ScenePreset preset : kAllPresets) {
    if (name == Traits(preset).name) return preset;
    accepted += std::string(accepted.empty() ? "" : ", ") + Traits(preset).name;
  }
  throw SceneError("the preset \"" + name +
                   "\" is not accepted; expected one of: " + accepted);
}

Scene MakePresetScene(ScenePreset preset, const PresetOptions& options) {
  const PresetTraits& traits = Traits(preset);
  ClothObject cloth = BuildClothFromMesh(
      MakeGrid(options.rows, options.cols, options.size, traits.plane),
      options.material);
  PinVertices(PinnedVertices(traits, options.rows, options.cols), &cloth);
  return MakeClothScene(preset, std::move(cloth));
}

Scene MakeClothScene(ScenePreset preset, ClothObject cloth) {
  const PresetTraits& traits = Traits(preset);
  Scene scene;
  scene.title = traits.name;
  scene.num_frames = traits.num_frames;
  scene.wind = traits.wind;
  scene.objects.push_back(std::move(cloth));
  ApplySettings("nL", &scene);
  return scene;
}

}  // namespace dpe
