// Colliders as surfaces.
#ifndef DPE_VIEWER_SCENE_VIEW_COLLIDER_SHAPES_H_
#define DPE_VIEWER_SCENE_VIEW_COLLIDER_SHAPES_H_

#include "dpe/engine/scene.h"
#include "picture/picture.h"
#include "scene_view/camera.h"

namespace dpe::viewer {

// A sphere as it is; of a plane, which has no end, the square about the place that is
// nearest to the ball, as large as the ball asks for.
Surface ColliderSurface(const Collider& collider, const Ball& ball);

// The outward normal of a plane: +y turned by R_y R_x R_z.
Eigen::Vector3d PlaneColliderNormal(const Collider& collider);

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_SCENE_VIEW_COLLIDER_SHAPES_H_
