// The parameters of several motions of the same cloths.
//
// A segment is one motion with a scene of its own: where it starts, what is pinned and
// moved, its wind, gravity and colliders, its frames. What the cloths are made of -
// mass, stiffness, damping, drag - is the same in all of them and is one block of
// unknowns; initial velocities and positions belong to a segment, and so does the wind
// where that is asked for.
//
// Shared blocks are those of a scene in which a vertex is fixed only if it is fixed in
// every segment: they hold every element that has influence in any segment. A segment's
// own layout (that of its simulator) holds the elements with influence there;
// indices() says where they stand in the joint vector.
#ifndef DPE_ESTIMATION_JOINT_LAYOUT_H_
#define DPE_ESTIMATION_JOINT_LAYOUT_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "dpe/engine/parameters.h"
#include "dpe/engine/scene.h"
#include "dpe/estimation/export.h"

namespace dpe {

class DPE_ESTIMATION_API JointLayout {
 public:
  // One segment: the scene's own layout. Several: the shared blocks in the order of
  // ParameterLayout, then the blocks of each segment.
  //
  // @param scenes    one per segment, at least one
  // @param own_wind  whether each segment has a wind of its own to be estimated
  // @throws SceneError if the scenes' objects are not the same cloths, see
  //         RequireSameCloths
  JointLayout(std::vector<const Scene*> scenes, bool own_wind);

  const ParameterLayout& layout() const { return layout_; }
  int num_segments() const { return static_cast<int>(indices_.size()); }

  // For each parameter of the segment's own layout, its place in the joint vector.
  const std::vector<int>& indices(int segment) const { return indices_[segment]; }
  // The joint blocks that the segment's motion depends on, ascending.
  const std::vector<int>& blocks(int segment) const { return blocks_[segment]; }
  // The joint block of a segment's own block, by its place in the segment's layout.
  int JointBlock(int segment, int own_block) const {
    return joint_block_[segment][own_block];
  }

  // The joint vector that describes the scenes best: shared values as those of the
  // first segment in which the element has influence.
  Eigen::VectorXd Extract(const std::vector<const Scene*>& scenes) const;

  // The segment's part of the joint vector, in the order of its own layout.
  Eigen::VectorXd Gather(const Eigen::VectorXd& joint, int segment) const;

  // joint += the segment's values.
  void ScatterAdd(const Eigen::VectorXd& values, int segment,
                  Eigen::VectorXd* joint) const;

 private:
  void MapSegment(const ParameterLayout& own, int segment);

  bool own_wind_;
  ParameterLayout layout_;
  std::vector<std::vector<int>> indices_, blocks_, joint_block_;
};

// Checks that the scenes hold the same cloths: as many objects of the same vertices,
// springs, triangles, groups and rest lengths (to 1e-6 relative), of which the same is
// estimated, and the same values of what is not (to 1e-9 relative).
// @param scenes  at least one
// @param names   of the scenes in messages; empty: "scene 0", "scene 1", ...
// @throws SceneError naming scenes, object, quantity and both values
DPE_ESTIMATION_API void RequireSameCloths(const std::vector<const Scene*>& scenes,
                                          const std::vector<std::string>& names = {});

}  // namespace dpe

#endif  // DPE_ESTIMATION_JOINT_LAYOUT_H_
