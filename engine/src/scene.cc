#include "dpe/engine/scene.h"

#include <cctype>
#include <utility>

namespace dpe {
namespace {

struct MethodName {
  IntegrationMethod method;
  const char* name;
};

constexpr MethodName kMethodNames[] = {
    {IntegrationMethod::kExplicitEuler, "explicit_euler"},
    {IntegrationMethod::kSymplecticEuler, "symplectic_euler"},
    {IntegrationMethod::kLinearlyImplicitEuler, "linearly_implicit_euler"},
    {IntegrationMethod::kImplicitEuler, "implicit_euler"},
    {IntegrationMethod::kTrBdf2, "tr_bdf2"},
};

using TwoModes = std::pair<ParameterMode, ParameterMode>;  // mass, stiffness

TwoModes ModesFromLetters(const std::string& entry, const std::string& settings) {
  if (entry.size() != 2) {
    throw SceneError(
        "settings \"" + settings + "\": \"" + entry +
        "\" is not accepted; expected two letters per object (mass, then "
        "stiffness) of n, G, L, R, objects separated by commas: \"nL,nn\"");
  }
  return {ParameterModeFromLetter(entry[0]), ParameterModeFromLetter(entry[1])};
}

std::vector<TwoModes> ParseSettings(const std::string& settings) {
  std::vector<TwoModes> modes;
  if (settings.empty()) return modes;
  size_t begin = 0;
  while (true) {
    const size_t end = settings.find(',', begin);
    modes.push_back(ModesFromLetters(settings.substr(begin, end - begin), settings));
    if (end == std::string::npos) return modes;
    begin = end + 1;
  }
}

}  // namespace

char ParameterModeLetter(ParameterMode mode) {
  switch (mode) {
    case ParameterMode::kGlobal:
      return 'G';
    case ParameterMode::kLocal:
      return 'L';
    case ParameterMode::kGroup:
      return 'R';
    case ParameterMode::kFixed:
      break;
  }
  return 'n';
}

ParameterMode ParameterModeFromLetter(char letter) {
  switch (std::toupper(static_cast<unsigned char>(letter))) {
    case 'N':
      return ParameterMode::kFixed;
    case 'G':
      return ParameterMode::kGlobal;
    case 'L':
      return ParameterMode::kLocal;
    case 'R':
      return ParameterMode::kGroup;
    default:
      throw SceneError(std::string("the letter \"") + letter +
                       "\" is not accepted; expected n (fixed), G (one value per "
                       "object), L (one per element) or R (one per group)");
  }
}

std::string IntegrationMethodName(IntegrationMethod method) {
  for (const MethodName& entry : kMethodNames) {
    if (entry.method == method) return entry.name;
  }
  return std::to_string(static_cast<int>(method));
}

IntegrationMethod IntegrationMethodFromName(const std::string& name) {
  std::string accepted;
  for (const MethodName& entry : kMethodNames) {
    const std::string number = std::to_string(static_cast<int>(entry.method));
    if (name == entry.name || name == number) return entry.method;
    accepted += (accepted.empty() ? "" : ", ") + number + " " + entry.name;
  }
  throw SceneError(
      "the integration method \"" + name +
      "\" is not accepted; expected the number or the name of one of: " + accepted);
}

void ApplySettings(const std::string& settings, Scene* scene) {
  std::vector<TwoModes> modes = ParseSettings(settings);
  if (modes.size() > scene->objects.size()) {
    throw SceneError("settings \"" + settings + "\" are for " +
                     std::to_string(modes.size()) + " objects; the scene has " +
                     std::to_string(scene->objects.size()));
  }
  modes.resize(scene->objects.size(), {ParameterMode::kFixed, ParameterMode::kFixed});
  for (size_t i = 0; i < modes.size(); ++i) {
    scene->objects[i].mass_mode = modes[i].first;
    scene->objects[i].stiffness_mode = modes[i].second;
  }
}

std::string SettingsString(const Scene& scene) {
  std::string settings;
  size_t last_estimated = 0;  // length up to the last entry that is not nn
  for (const ClothObject& object : scene.objects) {
    if (&object != &scene.objects.front()) settings += ',';
    settings += ParameterModeLetter(object.mass_mode);
    settings += ParameterModeLetter(object.stiffness_mode);
    if (object.mass_mode != ParameterMode::kFixed ||
        object.stiffness_mode != ParameterMode::kFixed) {
      last_estimated = settings.size();
    }
  }
  return settings.substr(0, last_estimated);
}

Eigen::VectorXd RestLengths(const ClothObject& object) {
  if (object.rest_length.size() > 0) return object.rest_length;
  Eigen::VectorXd lengths(object.num_springs());
  for (int s = 0; s < object.num_springs(); ++s) {
    const auto [a, b] = object.springs[s];
    lengths[s] =
        (object.positions.segment<3>(3 * a) - object.positions.segment<3>(3 * b))
            .norm();
  }
  return lengths;
}

std::vector<int> SpringGroups(const ClothObject& object) {
  if (!object.spring_group.empty()) return object.spring_group;
  std::vector<int> groups(object.springs.size(), 0);
  for (size_t s = 0; s < object.spring_kind.size() && s < groups.size(); ++s) {
    groups[s] = static_cast<int>(object.spring_kind[s]);
  }
  return groups;
}

std::vector<int> VertexGroups(const ClothObject& object) {
  if (!object.vertex_group.empty()) return object.vertex_group;
  return std::vector<int>(object.is_fixed.size(), 0);
}

}  // namespace dpe
