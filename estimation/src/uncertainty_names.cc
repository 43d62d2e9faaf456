#include "uncertainty_names.h"

#include <array>
#include <cmath>
#include <set>
#include <sstream>

namespace dpe {
namespace {

// The group number of each element of a block.
std::vector<int> GroupsOf(const ClothObject& object, ParameterKind kind) {
  return kind == ParameterKind::kMass ? VertexGroups(object) : SpringGroups(object);
}

// "the shear stiffness" where a group is the springs of one kind, else "the stiffness
// of group 2".
std::string GroupName(const ClothObject& object, const ParameterBlock& block,
                      int local) {
  const std::vector<int> groups = GroupsOf(object, block.kind);
  int group = 0;
  std::set<SpringKind> inside, outside;
  const bool has_kinds =
      block.kind == ParameterKind::kStiffness && !object.spring_kind.empty();
  for (size_t e = 0; e < block.element_to_local.size(); ++e) {
    // Springs between fixed vertices are in no group.
    if (block.element_to_local[e] < 0) continue;
    const bool belongs = block.element_to_local[e] == local;
    if (belongs) group = groups[e];
    if (has_kinds) (belongs ? inside : outside).insert(object.spring_kind[e]);
  }
  if (inside.size() == 1 && outside.count(*inside.begin()) == 0) {
    return "the " + SpringKindName(*inside.begin()) + " stiffness";
  }
  return "the " + ParameterKindName(block.kind) + " of group " + std::to_string(group);
}

// One element of a block of mode L.
std::string ElementName(const Scene& scene, const ParameterBlock& block, int element) {
  static const char* const kAxis[] = {"x", "y", "z"};
  const std::string of_object = OfBlock(block);
  switch (block.kind) {
    case ParameterKind::kWind:
      return std::string("the wind along ") + kAxis[element] + of_object;
    case ParameterKind::kInitialVelocity:
    case ParameterKind::kInitialPosition:
      return "the " + ParameterKindName(block.kind) + " along " + kAxis[element % 3] +
             " of vertex " + std::to_string(element / 3) + of_object;
    case ParameterKind::kStiffness: {
      const std::array<int, 2>& ends = scene.objects[block.object].springs[element];
      return "the stiffness of spring " + std::to_string(element) + of_object +
             " (vertices " + std::to_string(ends[0]) + "-" + std::to_string(ends[1]) +
             ")";
    }
    default:
      return "the mass of vertex " + std::to_string(element) + of_object;
  }
}

}  // namespace

std::vector<std::string> ParameterNames(const Scene& scene,
                                        const ParameterLayout& layout) {
  std::vector<std::string> names(layout.size());
  for (const ParameterBlock& block : layout.blocks()) {
    if (block.mode == ParameterMode::kGroup) {
      for (int k = 0; k < block.size; ++k) {
        names[block.offset + k] =
            GroupName(scene.objects[block.object], block, k) + OfBlock(block);
      }
      continue;
    }
    for (size_t e = 0; e < block.element_to_local.size(); ++e) {
      const int local = block.element_to_local[e];
      if (local < 0) continue;
      names[block.offset + local] =
          block.mode == ParameterMode::kLocal
              ? ElementName(scene, block, static_cast<int>(e))
              : "the " + ParameterKindName(block.kind) + OfBlock(block);
    }
  }
  return names;
}

std::string BlockQuantity(ParameterKind kind) {
  switch (kind) {
    case ParameterKind::kWind:
      return "wind strength";
    case ParameterKind::kInitialVelocity:
      return "initial speed";
    default:
      return ParameterKindName(kind);
  }
}

std::string OfObject(int object) {
  return object < 0 ? "" : " of object " + std::to_string(object);
}

std::string OfBlock(const ParameterBlock& block) {
  return OfObject(block.object) +
         (block.segment < 0 ? "" : " in capture " + std::to_string(block.segment + 1));
}

std::string Listed(const std::vector<std::string>& parts) {
  std::string text;
  for (size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) text += i + 1 == parts.size() ? " and " : ", ";
    text += parts[i];
  }
  return text;
}

std::string Short(double value) {
  std::ostringstream text;
  text.precision(3);
  text << value;
  return text.str();
}

std::string RelativeSpread(double deviation) {
  constexpr double kPercent = 0.3;   // beyond, relative deviations are factors
  constexpr double kLargest = 13.8;  // ln 1e6
  if (deviation <= kPercent) return Short(100.0 * deviation) + " %";
  if (deviation > kLargest) return "a factor of more than a million";
  return "a factor of " + Short(std::exp(deviation));
}

std::string Spread(ParameterKind kind, double deviation, double size) {
  if (ParameterKindIsPositive(kind)) return RelativeSpread(deviation);
  return Short(deviation * size) + " " + ParameterKindUnit(kind);
}

}  // namespace dpe
