// The axes of the stability experiment, and the scene of each value.
//
// The base is a cloth of 6 x 6 vertices that swings down from one pinned edge for 0.2 s
// in a light wind: springs of 50 N/m, vertices of about 0.1 kg, steps of 2 ms, damping
// 0.01 1/s. All integrators are stable and accurate there; each axis changes one thing.
#ifndef DPE_TOOLS_EXPERIMENTS_STABILITY_STABILITY_SCENE_H_
#define DPE_TOOLS_EXPERIMENTS_STABILITY_STABILITY_SCENE_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "dpe/engine/scene.h"

namespace dpe::experiments {

struct StabilityAxis {
  std::string name;
  std::string label;  // of the axis in tables and plots, with unit
  std::vector<double> values;
};

const std::vector<StabilityAxis>& StabilityAxes();

struct StabilityScene {
  Scene scene;               // method and solver are the caller's to choose
  int num_frames = 101;      // states, the first one included
  int gradient_frames = 21;  // of the rollouts that are differentiated
  // Added to all positions before the cell simulates; its result is compared after
  // subtracting it, since the laws do not know where the origin is.
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
};

// @throws SceneError for an axis that there is not
StabilityScene MakeStabilityScene(const std::string& axis, double value);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_STABILITY_STABILITY_SCENE_H_
