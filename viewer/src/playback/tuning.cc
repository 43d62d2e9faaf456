#include "playback/tuning.h"

namespace dpe::viewer {

bool operator==(const ObjectTuning& a, const ObjectTuning& b) {
  return a.stiffness_factor == b.stiffness_factor && a.mass_factor == b.mass_factor &&
         a.damping == b.damping && a.drag_coefficient == b.drag_coefficient;
}

bool operator==(const Tuning& a, const Tuning& b) {
  return a.objects == b.objects && a.wind == b.wind;
}

Tuning TuningOf(const Scene& scene) {
  Tuning tuning;
  for (const ClothObject& object : scene.objects) {
    tuning.objects.push_back({1.0, 1.0, object.damping, object.drag_coefficient});
  }
  tuning.wind = scene.wind;
  return tuning;
}

Scene TunedScene(const Scene& scene, const Tuning& tuning) {
  Scene tuned = scene;
  for (size_t o = 0; o < tuned.objects.size(); ++o) {
    const ObjectTuning& values = tuning.objects[o];
    tuned.objects[o].stiffness *= values.stiffness_factor;
    tuned.objects[o].mass *= values.mass_factor;
    tuned.objects[o].damping = values.damping;
    tuned.objects[o].drag_coefficient = values.drag_coefficient;
  }
  tuned.wind = tuning.wind;
  return tuned;
}

void ApplyTuning(const Scene& scene, const Tuning& from, const Tuning& to,
                 LiveSimulation* simulation) {
  for (int o = 0; o < simulation->num_objects(); ++o) {
    const ObjectTuning &before = from.objects[o], &now = to.objects[o];
    if (before == now) continue;
    simulation->SetStiffness(o, now.stiffness_factor * scene.objects[o].stiffness);
    simulation->SetMass(o, now.mass_factor * scene.objects[o].mass);
    simulation->SetDamping(o, now.damping);
    simulation->SetDragCoefficient(o, now.drag_coefficient);
  }
  if (from.wind != to.wind) simulation->SetWind(to.wind);
}

}  // namespace dpe::viewer
