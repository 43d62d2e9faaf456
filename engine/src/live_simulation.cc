#include "dpe/engine/live_simulation.h"

#include <string>

#include "dpe/engine/parallel.h"
#include "dpe/engine/scene_io.h"
#include "live_object.h"
#include "validation/collider_validation.h"
#include "validation/report.h"

namespace dpe {
namespace {

ValidationReport Report() {
  static const std::string* const kSource = new std::string("live simulation");
  return ValidationReport(*kSource, nullptr);
}

std::string ObjectKey(int object, const std::string& key) {
  return "objects[" + std::to_string(object) + "]." + key;
}

std::string Index(int index) { return "[" + std::to_string(index) + "]"; }

}  // namespace

LiveSimulation::LiveSimulation(const Scene& scene, const SimulatorOptions& options)
    : scene_(scene), options_(options), statuses_(scene.objects.size()) {
  ValidateScene(scene, "scene");
  for (int o = 0; o < static_cast<int>(scene.objects.size()); ++o) {
    objects_.push_back(std::make_unique<LiveObject>(scene_, options_, o));
  }
}

LiveSimulation::~LiveSimulation() = default;

const Eigen::VectorXd& LiveSimulation::positions(int object) const {
  return objects_[object]->positions();
}

const Eigen::VectorXd& LiveSimulation::velocities(int object) const {
  return objects_[object]->velocities();
}

RolloutStatus LiveSimulation::AdvanceFrame() {
  ParallelFor(options_.num_threads, num_objects(),
              [this](int o) { statuses_[o] = objects_[o]->Advance(frame_); });
  // Objects do not part: none goes on if one cannot.
  for (const RolloutStatus& status : statuses_) {
    if (status.ok()) continue;
    for (const auto& object : objects_) object->ForgetSteps();
    return status;
  }
  for (const auto& object : objects_) object->Accept();
  ++frame_;
  return {};
}

void LiveSimulation::Restart() {
  for (const auto& object : objects_) object->Restart();
  frame_ = 0;
}

LiveObject& LiveSimulation::At(int object, const char* what) {
  if (object < 0 || object >= num_objects()) {
    Report().Fail(what, "object " + std::to_string(object),
                  "an index from 0 to " + std::to_string(num_objects() - 1));
  }
  return *objects_[object];
}

void LiveSimulation::SetState(int object, const Eigen::VectorXd& positions,
                              const Eigen::VectorXd& velocities) {
  LiveObject& live = At(object, "SetState");
  const long n = live.positions().size();
  const auto check = [&](const char* key, const Eigen::VectorXd& values) {
    Report().RequireSize(ObjectKey(object, key), values.size(), n,
                         "three coordinates per vertex");
    if (!values.allFinite()) {
      Report().Fail(ObjectKey(object, key), "NaN or infinity", "finite numbers");
    }
  };
  check("vertPos", positions);
  check("vertVel", velocities);
  live.SetState(positions, velocities);
}

void LiveSimulation::SetFixedPosition(int object, int vertex,
                                      const Eigen::Vector3d& position) {
  LiveObject& live = At(object, "SetFixedPosition");
  const ClothObject& cloth = scene_.objects[object];
  const bool is_fixed =
      vertex >= 0 && vertex < cloth.num_vertices() && cloth.is_fixed[vertex];
  if (!is_fixed || !position.allFinite()) {
    const std::string key = ObjectKey(object, "vertPos" + Index(vertex));
    Report().RequireFinite(key, position);
    Report().Fail(key, "vertex " + std::to_string(vertex), "a fixed vertex");
  }
  live.SetFixedPosition(vertex, position);
}

void LiveSimulation::SetMass(int object, const Eigen::VectorXd& mass) {
  LiveObject& live = At(object, "SetMass");
  ClothObject& cloth = scene_.objects[object];
  const std::string key = ObjectKey(object, "vertMass");
  Report().RequireSize(key, mass.size(), cloth.num_vertices(), "one per vertex");
  for (int i = 0; i < cloth.num_vertices(); ++i) {
    if (cloth.is_fixed[i]) {
      Report().RequireNotNegative(key + Index(i), mass[i], "a finite mass >= 0 kg");
    } else {
      Report().RequirePositive(key + Index(i), mass[i], "a finite mass > 0 kg");
    }
  }
  cloth.mass = mass;
  live.TakeParameters();
}

void LiveSimulation::SetStiffness(int object, const Eigen::VectorXd& stiffness) {
  LiveObject& live = At(object, "SetStiffness");
  ClothObject& cloth = scene_.objects[object];
  const std::string key = ObjectKey(object, "springStiffness");
  Report().RequireSize(key, stiffness.size(), cloth.num_springs(), "one per spring");
  for (int s = 0; s < cloth.num_springs(); ++s) {
    Report().RequireNotNegative(key + Index(s), stiffness[s],
                                "a finite stiffness >= 0 N/m");
  }
  cloth.stiffness = stiffness;
  live.TakeParameters();
}

void LiveSimulation::SetDamping(int object, double damping) {
  LiveObject& live = At(object, "SetDamping");
  Report().RequireNotNegative(ObjectKey(object, "damping"), damping,
                              "a finite number >= 0");
  scene_.objects[object].damping = damping;
  live.TakeParameters();
}

void LiveSimulation::SetDragCoefficient(int object, double drag_coefficient) {
  LiveObject& live = At(object, "SetDragCoefficient");
  Report().RequireNotNegative(ObjectKey(object, "dragCoefficient"), drag_coefficient,
                              "a finite number >= 0");
  scene_.objects[object].drag_coefficient = drag_coefficient;
  live.TakeParameters();
}

void LiveSimulation::SetWind(const Eigen::Vector3d& wind) {
  if (!wind.allFinite()) Report().RequireFinite("windVel", wind);
  scene_.wind = wind;
  for (const auto& object : objects_) object->TakeParameters();
}

void LiveSimulation::SetColliders(const std::vector<Collider>& colliders) {
  ValidateColliders(colliders, Report());
  scene_.colliders = colliders;
  for (const auto& object : objects_) object->TakeColliders();
}

}  // namespace dpe
