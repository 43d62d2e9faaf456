// The parameter vector: which quantities of a scene are unknown, and where each stands
// in the vector p that rollouts and derivatives are functions of. SI units.
#ifndef DPE_ENGINE_PARAMETERS_H_
#define DPE_ENGINE_PARAMETERS_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "dpe/engine/export.h"
#include "dpe/engine/scene.h"

namespace dpe {

enum class ParameterKind {
  kMass,             // kg, elements are the object's vertices
  kStiffness,        // N/m, elements are the object's springs
  kDamping,          // 1/s, one element
  kDrag,             // drag coefficient, one element
  kWind,             // m/s, elements are x, y, z; belongs to the scene
  kInitialVelocity,  // m/s, elements are the 3N velocity components
  kInitialPosition,  // m, elements are the 3N coordinates
};

DPE_ENGINE_API std::string ParameterKindName(
    ParameterKind kind);  // "mass", "stiffness", ...
DPE_ENGINE_API std::string ParameterKindUnit(
    ParameterKind kind);  // "kg", "N/m", "1/s", "1", "m/s", "m"

// True for quantities that are positive by nature (mass, stiffness, damping, drag).
DPE_ENGINE_API bool ParameterKindIsPositive(ParameterKind kind);

// One group of unknowns of one kind: the unit in which users and optimisers see them.
struct ParameterBlock {
  ParameterKind kind = ParameterKind::kMass;
  int object = -1;  // index into Scene::objects; -1: the scene's own
  ParameterMode mode = ParameterMode::kGlobal;
  int offset = 0;  // of the block's first value in the parameter vector
  int size = 0;    // number of unknowns
  // In a layout that several motions of the same cloths share: which of them alone has
  // this block. -1: all of them.
  int segment = -1;
  // For each element, its place in the block, or -1 for an element without influence
  // on the motion (a fixed vertex's mass, a spring between fixed vertices).
  std::vector<int> element_to_local;
};

// All blocks of a scene, in a fixed order: for each object mass, stiffness, damping,
// drag, initial velocity, initial position (those that are estimated), then the scene's
// wind.
class DPE_ENGINE_API ParameterLayout {
 public:
  ParameterLayout() = default;
  explicit ParameterLayout(const Scene& scene);
  // These blocks in this order; their offsets are set.
  explicit ParameterLayout(std::vector<ParameterBlock> blocks);

  const std::vector<ParameterBlock>& blocks() const { return blocks_; }
  int size() const { return size_; }

  // The parameter vector that describes `scene` best: the element's value for mode L,
  // the mean over the elements with influence for G and R.
  // @param scene    one that the layout is of
  // @param segment  which of several motions the scene is; the blocks that others alone
  //                 have are left zero
  Eigen::VectorXd Extract(const Scene& scene, int segment = 0) const;

  // True if block `b` can express the scene's values exactly (always for L; for G and R
  // if all elements of each group are equal to 1e-12 relative). Only then is a
  // deviation from "true values" defined.
  bool Represents(const Scene& scene, int b) const;

  // Writes the values into the scene; elements without influence keep theirs.
  // @param parameters  layout order, SI units
  // @param scene       one that the layout is of
  // @param segment     as for Extract; the blocks that others alone have are left out
  void Insert(const Eigen::VectorXd& parameters, Scene* scene, int segment = 0) const;

  // True if `object` has an estimated parameter, or the wind is estimated and the
  // object feels it: the objects that an estimation has to simulate.
  static bool ObjectIsEstimated(const Scene& scene, int object);

  // The same for all objects at once, 1 or 0 each.
  static std::vector<char> EstimatedObjects(const Scene& scene);

 private:
  std::vector<ParameterBlock> blocks_;
  int size_ = 0;
};

}  // namespace dpe

#endif  // DPE_ENGINE_PARAMETERS_H_
