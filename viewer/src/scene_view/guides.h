// What tells up from down and how large things are: ground, axes, wind.
#ifndef DPE_VIEWER_SCENE_VIEW_GUIDES_H_
#define DPE_VIEWER_SCENE_VIEW_GUIDES_H_

#include <Eigen/Core>
#include <glm/vec4.hpp>

#include "dpe/engine/scene.h"
#include "picture/picture.h"
#include "scene_view/camera.h"

namespace dpe::viewer {

// The ball about all cloths where they start and where they will fall.
Ball BallAbout(const Scene& scene);
// The highest place of a cloth where it starts, m.
double TopOf(const Scene& scene);

// Where the ground is drawn, m: at the highest level plane collider, else where a cloth
// that falls from its pins just does not reach.
double GroundLevel(const Scene& scene);

// Length of a square of the grid, m: 1, 2 or 5 times a power of ten.
double GridSpacing(const Ball& ball);

// Squares of grid spacing under the ball, which fade into the background away from it.
Lines GroundGrid(const Ball& ball, double level, const glm::vec4& background);

// x red, y green, z blue, one grid square long, at a corner of the grid's middle.
Lines Axes(const Ball& ball, double level);

// Above the middle of the ball and above `top`, along the wind; the longer the
// stronger. Empty without wind.
Lines WindArrow(const Ball& ball, double top, const Eigen::Vector3d& wind);

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_SCENE_VIEW_GUIDES_H_
