// What a person turns while a cloth moves: a scene's parameters as a whole.
#ifndef DPE_VIEWER_PLAYBACK_TUNING_H_
#define DPE_VIEWER_PLAYBACK_TUNING_H_

#include <Eigen/Core>
#include <vector>

#include "dpe/engine/live_simulation.h"
#include "dpe/engine/scene.h"

namespace dpe::viewer {

struct ObjectTuning {
  double stiffness_factor = 1.0;  // of every spring's stiffness
  double mass_factor = 1.0;       // of every vertex's mass
  double damping = 0.0;           // as ClothObject's
  double drag_coefficient = 0.0;
};

struct Tuning {
  std::vector<ObjectTuning> objects;               // one per object of the scene
  Eigen::Vector3d wind = Eigen::Vector3d::Zero();  // m/s
};

bool operator==(const ObjectTuning& a, const ObjectTuning& b);
bool operator==(const Tuning& a, const Tuning& b);

// The tuning that leaves the scene as it is.
Tuning TuningOf(const Scene& scene);

// The scene with that tuning.
Scene TunedScene(const Scene& scene, const Tuning& tuning);

// Brings a simulation of `scene` from one tuning to another.
void ApplyTuning(const Scene& scene, const Tuning& from, const Tuning& to,
                 LiveSimulation* simulation);

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_PLAYBACK_TUNING_H_
