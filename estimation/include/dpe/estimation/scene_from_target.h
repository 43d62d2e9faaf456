// A scene from a recorded mesh alone, for a recording that comes without one.
#ifndef DPE_ESTIMATION_SCENE_FROM_TARGET_H_
#define DPE_ESTIMATION_SCENE_FROM_TARGET_H_

#include <string>
#include <vector>

#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/scene.h"
#include "dpe/estimation/export.h"
#include "dpe/estimation/load_target.h"

namespace dpe {

struct SceneFromTargetOptions {
  // Its stiffnesses are where a start is looked for if they are estimated.
  ClothMaterial material;
  // Vertices to pin, counted among those that belong to a face; empty: those that never
  // move (by more than 1e-5 of the cloth's extent).
  std::vector<int> pins;
  bool without_pins = false;
  // What was not simulated by dpe has none of its errors in it: steps that are
  // accurate.
  IntegrationMethod integration_method = IntegrationMethod::kTrBdf2;
  int steps_per_frame = 4;
};

// One cloth that starts in the first frame of a recording of meshes, with the rest
// shape that target.rest_shape says (empty: that frame), gravity, no wind, and drag by
// the unit_normal law. A frame is as long as target.capture.rate says.
//
// @param path     file, folder or pattern of a format with triangles, see ReadCapture
// @param target   how it is read
// @param options  what the cloth is made of, its pins and time steps
// @throws SceneError for a format without triangles, a rate that is not given, and as
//         ReadCapture and BuildClothFromCapture
DPE_ESTIMATION_API Scene SceneFromTarget(const std::string& path,
                                         const TargetOptions& target,
                                         const SceneFromTargetOptions& options);

}  // namespace dpe

#endif  // DPE_ESTIMATION_SCENE_FROM_TARGET_H_
