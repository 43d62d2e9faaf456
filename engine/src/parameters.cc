#include "dpe/engine/parameters.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <utility>

namespace dpe {
namespace {

// Which elements of a quantity have influence on the motion, and their groups.
struct Elements {
  std::vector<char> is_active;
  std::vector<int> group;  // used by kGroup only
};

bool AnyFree(const ClothObject& object) {
  return std::find(object.is_fixed.begin(), object.is_fixed.end(), 0) !=
         object.is_fixed.end();
}

bool HasFreeTriangle(const ClothObject& object) {
  return std::any_of(object.triangles.begin(), object.triangles.end(),
                     [&](const std::array<int, 3>& t) {
                       return !object.is_fixed[t[0]] || !object.is_fixed[t[1]] ||
                              !object.is_fixed[t[2]];
                     });
}

bool FeelsWind(const ClothObject& object) {
  return (object.drag_coefficient != 0.0 || object.estimate_drag) &&
         HasFreeTriangle(object);
}

Elements MassElements(const ClothObject& object) {
  Elements elements;
  for (char is_fixed : object.is_fixed) elements.is_active.push_back(!is_fixed);
  elements.group = VertexGroups(object);
  return elements;
}

Elements StiffnessElements(const ClothObject& object) {
  Elements elements;
  for (const std::array<int, 2>& spring : object.springs) {
    elements.is_active.push_back(!object.is_fixed[spring[0]] ||
                                 !object.is_fixed[spring[1]]);
  }
  elements.group = SpringGroups(object);
  return elements;
}

Elements StateElements(const ClothObject& object) {
  Elements elements;
  for (char is_fixed : object.is_fixed) {
    elements.is_active.insert(elements.is_active.end(), 3, !is_fixed);
  }
  return elements;
}

// Numbers the unknowns of a block: element_to_local and size.
void NumberUnknowns(const Elements& elements, ParameterBlock* block) {
  const size_t n = elements.is_active.size();
  block->element_to_local.assign(n, -1);
  block->size = 0;
  if (block->mode == ParameterMode::kLocal) {
    for (size_t e = 0; e < n; ++e) {
      if (elements.is_active[e]) block->element_to_local[e] = block->size++;
    }
    return;
  }
  std::map<int, int> local_of_group;  // sorted by group number
  const auto group = [&](size_t e) {
    return block->mode == ParameterMode::kGroup ? elements.group[e] : 0;
  };
  for (size_t e = 0; e < n; ++e) {
    if (elements.is_active[e]) local_of_group[group(e)] = 0;
  }
  for (auto& entry : local_of_group) entry.second = block->size++;
  for (size_t e = 0; e < n; ++e) {
    if (elements.is_active[e]) block->element_to_local[e] = local_of_group[group(e)];
  }
}

// The values of all elements of a block's quantity, active or not.
Eigen::VectorXd ElementValues(const Scene& scene, const ParameterBlock& block) {
  if (block.kind == ParameterKind::kWind) return scene.wind;
  const ClothObject& object = scene.objects[block.object];
  switch (block.kind) {
    case ParameterKind::kMass:
      return object.mass;
    case ParameterKind::kStiffness:
      return object.stiffness;
    case ParameterKind::kDamping:
      return Eigen::VectorXd::Constant(1, object.damping);
    case ParameterKind::kDrag:
      return Eigen::VectorXd::Constant(1, object.drag_coefficient);
    case ParameterKind::kInitialVelocity:
      return object.velocities;
    case ParameterKind::kInitialPosition:
      return object.positions;
    case ParameterKind::kWind:
      break;
  }
  return {};
}

bool IsOf(int segment, const ParameterBlock& block) {
  return block.segment == -1 || block.segment == segment;
}

void SetElement(const ParameterBlock& block, int element, double value, Scene* scene) {
  if (block.kind == ParameterKind::kWind) {
    scene->wind[element] = value;
    return;
  }
  ClothObject* object = &scene->objects[block.object];
  switch (block.kind) {
    case ParameterKind::kMass:
      object->mass[element] = value;
      break;
    case ParameterKind::kStiffness:
      object->stiffness[element] = value;
      break;
    case ParameterKind::kDamping:
      object->damping = value;
      break;
    case ParameterKind::kDrag:
      object->drag_coefficient = value;
      break;
    case ParameterKind::kInitialVelocity:
      object->velocities[element] = value;
      break;
    case ParameterKind::kInitialPosition:
      object->positions[element] = value;
      break;
    case ParameterKind::kWind:
      break;
  }
}

}  // namespace

std::string ParameterKindName(ParameterKind kind) {
  switch (kind) {
    case ParameterKind::kMass:
      return "mass";
    case ParameterKind::kStiffness:
      return "stiffness";
    case ParameterKind::kDamping:
      return "damping";
    case ParameterKind::kDrag:
      return "drag";
    case ParameterKind::kWind:
      return "wind";
    case ParameterKind::kInitialVelocity:
      return "initial velocity";
    case ParameterKind::kInitialPosition:
      return "initial position";
  }
  return "";
}

std::string ParameterKindUnit(ParameterKind kind) {
  switch (kind) {
    case ParameterKind::kMass:
      return "kg";
    case ParameterKind::kStiffness:
      return "N/m";
    case ParameterKind::kDamping:
      return "1/s";
    case ParameterKind::kDrag:
      return "1";
    case ParameterKind::kWind:
    case ParameterKind::kInitialVelocity:
      return "m/s";
    case ParameterKind::kInitialPosition:
      return "m";
  }
  return "";
}

bool ParameterKindIsPositive(ParameterKind kind) {
  return kind != ParameterKind::kWind && kind != ParameterKind::kInitialVelocity &&
         kind != ParameterKind::kInitialPosition;
}

ParameterLayout::ParameterLayout(const Scene& scene) {
  // A block in which no element has influence has no unknowns and is left out.
  const auto add = [this](ParameterKind kind, int object, ParameterMode mode,
                          const Elements& elements) {
    ParameterBlock block;
    block.kind = kind;
    block.object = object;
    block.mode = mode;
    block.offset = size_;
    NumberUnknowns(elements, &block);
    if (block.size == 0) return;
    size_ += block.size;
    blocks_.push_back(std::move(block));
  };
  const auto one = [](bool is_active) { return Elements{{is_active}, {0}}; };

  bool any_feels_wind = false;
  for (int i = 0; i < static_cast<int>(scene.objects.size()); ++i) {
    const ClothObject& object = scene.objects[i];
    any_feels_wind |= FeelsWind(object);
    if (object.mass_mode != ParameterMode::kFixed) {
      add(ParameterKind::kMass, i, object.mass_mode, MassElements(object));
    }
    if (object.stiffness_mode != ParameterMode::kFixed) {
      add(ParameterKind::kStiffness, i, object.stiffness_mode,
          StiffnessElements(object));
    }
    if (object.estimate_damping) {
      add(ParameterKind::kDamping, i, ParameterMode::kGlobal, one(AnyFree(object)));
    }
    if (object.estimate_drag) {
      add(ParameterKind::kDrag, i, ParameterMode::kGlobal,
          one(HasFreeTriangle(object)));
    }
    if (object.estimate_initial_velocity) {
      add(ParameterKind::kInitialVelocity, i, ParameterMode::kLocal,
          StateElements(object));
    }
    if (object.estimate_initial_position) {
      add(ParameterKind::kInitialPosition, i, ParameterMode::kLocal,
          StateElements(object));
    }
  }
  if (scene.estimate_wind && any_feels_wind) {
    add(ParameterKind::kWind, -1, ParameterMode::kLocal, Elements{{1, 1, 1}, {}});
  }
}

ParameterLayout::ParameterLayout(std::vector<ParameterBlock> blocks)
    : blocks_(std::move(blocks)) {
  for (ParameterBlock& block : blocks_) {
    block.offset = size_;
    size_ += block.size;
  }
}

Eigen::VectorXd ParameterLayout::Extract(const Scene& scene, int segment) const {
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(size_);
  Eigen::VectorXd count = Eigen::VectorXd::Zero(size_);
  for (const ParameterBlock& block : blocks_) {
    if (!IsOf(segment, block)) continue;
    const Eigen::VectorXd values = ElementValues(scene, block);
    for (size_t e = 0; e < block.element_to_local.size(); ++e) {
      if (block.element_to_local[e] < 0) continue;
      const int p = block.offset + block.element_to_local[e];
      // A running mean: that of equal values is the value itself, bit by bit.
      count[p] += 1.0;
      mean[p] += (values[e] - mean[p]) / count[p];
    }
  }
  return mean;
}

bool ParameterLayout::Represents(const Scene& scene, int b) const {
  constexpr double kEqual = 1e-12;  // relative
  const ParameterBlock& block = blocks_[b];
  const Eigen::VectorXd values = ElementValues(scene, block);
  std::vector<int> first(block.size, -1);  // element that each unknown is compared to
  for (size_t e = 0; e < block.element_to_local.size(); ++e) {
    const int local = block.element_to_local[e];
    if (local < 0) continue;
    if (first[local] < 0) first[local] = static_cast<int>(e);
    const double reference = values[first[local]];
    if (std::abs(values[e] - reference) > kEqual * std::abs(reference)) return false;
  }
  return true;
}

void ParameterLayout::Insert(const Eigen::VectorXd& parameters, Scene* scene,
                             int segment) const {
  assert(parameters.size() == size_);
  for (const ParameterBlock& block : blocks_) {
    if (!IsOf(segment, block)) continue;
    for (size_t e = 0; e < block.element_to_local.size(); ++e) {
      if (block.element_to_local[e] < 0) continue;
      SetElement(block, static_cast<int>(e),
                 parameters[block.offset + block.element_to_local[e]], scene);
    }
  }
}

bool ParameterLayout::ObjectIsEstimated(const Scene& scene, int object) {
  return EstimatedObjects(scene)[object] != 0;
}

std::vector<char> ParameterLayout::EstimatedObjects(const Scene& scene) {
  std::vector<char> is_estimated(scene.objects.size(), 0);
  bool wind = false;
  const ParameterLayout layout(scene);
  for (const ParameterBlock& block : layout.blocks()) {
    if (block.object >= 0) is_estimated[block.object] = 1;
    wind = wind || block.kind == ParameterKind::kWind;
  }
  for (size_t object = 0; wind && object < scene.objects.size(); ++object) {
    if (FeelsWind(scene.objects[object])) is_estimated[object] = 1;
  }
  return is_estimated;
}

}  // namespace dpe
