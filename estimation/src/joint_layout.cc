#include "dpe/estimation/joint_layout.h"

#include <algorithm>
#include <utility>

namespace dpe {
namespace {

bool BelongsToSegment(ParameterKind kind, bool own_wind) {
  return kind == ParameterKind::kInitialVelocity ||
         kind == ParameterKind::kInitialPosition ||
         (kind == ParameterKind::kWind && own_wind);
}

bool SpringHasInfluence(const ClothObject& object, int spring) {
  const auto [a, b] = object.springs[spring];
  return !object.is_fixed[a] || !object.is_fixed[b];
}

// Makes of `shared` (an object of the first scene) one in which everything has
// influence that has in `other`, with its values.
void Unite(const ClothObject& other, ClothObject* shared) {
  for (int s = 0; s < shared->num_springs(); ++s) {
    if (SpringHasInfluence(other, s) && !SpringHasInfluence(*shared, s)) {
      shared->stiffness[s] = other.stiffness[s];
    }
  }
  for (int v = 0; v < shared->num_vertices(); ++v) {
    if (other.is_fixed[v] || !shared->is_fixed[v]) continue;
    shared->is_fixed[v] = 0;
    shared->mass[v] = other.mass[v];
  }
}

Scene SharedScene(const std::vector<const Scene*>& scenes, bool own_wind) {
  Scene shared = *scenes[0];
  shared.estimate_wind = false;
  for (const Scene* scene : scenes) {
    if (scene->estimate_wind && !own_wind && !shared.estimate_wind) {
      shared.estimate_wind = true;
      shared.wind = scene->wind;
    }
  }
  for (size_t o = 0; o < shared.objects.size(); ++o) {
    ClothObject& object = shared.objects[o];
    object.estimate_initial_velocity = object.estimate_initial_position = false;
    for (const Scene* scene : scenes) Unite(scene->objects[o], &object);
  }
  return shared;
}

}  // namespace

JointLayout::JointLayout(std::vector<const Scene*> scenes, bool own_wind)
    : own_wind_(own_wind) {
  const int num_segments = static_cast<int>(scenes.size());
  std::vector<ParameterLayout> own;
  for (const Scene* scene : scenes) own.emplace_back(*scene);
  if (num_segments == 1) {
    layout_ = own[0];
  } else {
    RequireSameCloths(scenes);
    std::vector<ParameterBlock> blocks =
        ParameterLayout(SharedScene(scenes, own_wind)).blocks();
    for (int s = 0; s < num_segments; ++s) {
      for (ParameterBlock block : own[s].blocks()) {
        if (!BelongsToSegment(block.kind, own_wind)) continue;
        block.segment = s;
        blocks.push_back(std::move(block));
      }
    }
    layout_ = ParameterLayout(std::move(blocks));
  }
  for (int s = 0; s < num_segments; ++s) MapSegment(own[s], s);
}

// Element by element: so groups and single elements are found alike.
void JointLayout::MapSegment(const ParameterLayout& own, int segment) {
  std::vector<int> indices(own.size(), -1), joint_blocks;
  for (const ParameterBlock& block : own.blocks()) {
    const auto& all = layout_.blocks();
    const auto joint =
        std::find_if(all.begin(), all.end(), [&](const ParameterBlock& b) {
          return b.kind == block.kind && b.object == block.object &&
                 (b.segment == -1 || b.segment == segment);
        });
    for (size_t e = 0; e < block.element_to_local.size(); ++e) {
      if (block.element_to_local[e] < 0) continue;
      indices[block.offset + block.element_to_local[e]] =
          joint->offset + joint->element_to_local[e];
    }
    joint_blocks.push_back(static_cast<int>(joint - all.begin()));
  }
  indices_.push_back(std::move(indices));
  joint_block_.push_back(joint_blocks);
  std::sort(joint_blocks.begin(), joint_blocks.end());
  blocks_.push_back(std::move(joint_blocks));
}

Eigen::VectorXd JointLayout::Extract(const std::vector<const Scene*>& scenes) const {
  if (num_segments() == 1) return layout_.Extract(*scenes[0]);
  Eigen::VectorXd joint = layout_.Extract(SharedScene(scenes, own_wind_), -1);
  for (int s = 0; s < num_segments(); ++s) {
    const Eigen::VectorXd values = layout_.Extract(*scenes[s], s);
    for (const ParameterBlock& block : layout_.blocks()) {
      if (block.segment != s) continue;
      joint.segment(block.offset, block.size) =
          values.segment(block.offset, block.size);
    }
  }
  return joint;
}

Eigen::VectorXd JointLayout::Gather(const Eigen::VectorXd& joint, int segment) const {
  return joint(indices_[segment]);
}

void JointLayout::ScatterAdd(const Eigen::VectorXd& values, int segment,
                             Eigen::VectorXd* joint) const {
  for (int i = 0; i < values.size(); ++i) (*joint)[indices_[segment][i]] += values[i];
}

}  // namespace dpe
