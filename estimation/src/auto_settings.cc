#include <algorithm>
#include <cctype>

#include "dpe/estimation/model_selection.h"

namespace dpe {
namespace {

constexpr char kAuto[] = "auto";

std::vector<std::string> Entries(const std::string& settings) {
  std::vector<std::string> entries;
  size_t begin = 0;
  for (size_t end; (end = settings.find(',', begin)) != std::string::npos;) {
    entries.push_back(settings.substr(begin, end - begin));
    begin = end + 1;
  }
  entries.push_back(settings.substr(begin));
  return entries;
}

// The objects of which the scene estimates mass or stiffness; all if there are none.
std::vector<int> EstimatedObjects(const Scene& scene) {
  std::vector<int> estimated, all;
  for (int object = 0; object < static_cast<int>(scene.objects.size()); ++object) {
    const ClothObject& cloth = scene.objects[object];
    all.push_back(object);
    if (cloth.mass_mode != ParameterMode::kFixed ||
        cloth.stiffness_mode != ParameterMode::kFixed) {
      estimated.push_back(object);
    }
  }
  return estimated.empty() ? all : estimated;
}

std::string Rejoined(const std::vector<std::string>& entries) {
  std::string settings;
  for (const std::string& entry : entries) {
    settings += (settings.empty() ? "" : ",") + entry;
  }
  return settings;
}

}  // namespace

std::vector<int> ApplyAutoSettings(const std::string& settings, Scene* scene) {
  std::vector<std::string> entries = Entries(settings);
  if (std::count(entries.begin(), entries.end(), kAuto) == 0) {
    if (settings.find(kAuto) != std::string::npos) {
      throw SceneError("settings \"" + settings +
                       "\" is not accepted; expected auto, or per object auto or two "
                       "letters (mass, then stiffness) of n, G, L, R, objects "
                       "separated by commas: \"auto,nn\"");
    }
    ApplySettings(settings, scene);
    return {};
  }
  if (settings == kAuto) {
    const std::vector<int> objects = EstimatedObjects(*scene);
    for (const int object : objects) {
      scene->objects[object].stiffness_mode = ParameterMode::kGlobal;
    }
    return objects;
  }
  std::vector<int> objects;
  for (size_t i = 0; i < entries.size(); ++i) {
    if (entries[i] != kAuto) continue;
    objects.push_back(static_cast<int>(i));
    const ParameterMode mass =
        i < scene->objects.size() ? scene->objects[i].mass_mode : ParameterMode::kFixed;
    entries[i] = {ParameterModeLetter(mass), 'G'};
  }
  ApplySettings(Rejoined(entries), scene);
  return objects;
}

}  // namespace dpe
