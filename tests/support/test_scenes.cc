#include "support/test_scenes.h"

#include <cmath>
#include <random>
#include <stdexcept>

#include "dpe/engine/cloth_builder.h"

namespace dpe::test {
namespace {

Scene ColliderScene(const PresetOptions& options) {
  Scene scene = MakePresetScene(ScenePreset::kCorners, options);
  scene.title = "collider";
  std::fill(scene.objects[0].is_fixed.begin() + 1, scene.objects[0].is_fixed.end(), 0);
  Collider sphere;
  sphere.type = ColliderType::kSphere;
  sphere.position = {0.3, -1.05, 0.2};
  sphere.scale = {2.0, 2.0, 2.0};
  Collider plane;
  plane.type = ColliderType::kPlane;
  plane.position = {0.0, -0.02, 3.0};
  plane.rotation_degrees = {-20.0, 10.0, 5.0};
  plane.stiffness = 500.0;
  scene.colliders = {sphere, plane};
  return scene;
}

Scene TwoObjectScene(const PresetOptions& options) {
  Scene scene = MakePresetScene(ScenePreset::kSide, options);
  scene.title = "two_objects";
  PresetOptions smaller = options;
  smaller.rows = options.rows - 1;
  smaller.size = 0.5 * options.size;
  ClothObject second = MakePresetScene(ScenePreset::kCorners, smaller).objects[0];
  const int n = second.num_vertices();
  for (int i = 0; i < n; ++i) second.velocities.segment<3>(3 * i) << 0.1, 0.2, -0.3;
  second.is_fixed[n / 2] = 1;
  second.velocities.segment<3>(3 * (n / 2)).setZero();
  PrescribedPath path;
  path.vertex = 0;
  path.positions.resize(3, 4);
  for (int f = 0; f < 4; ++f) {
    path.positions.col(f) =
        second.positions.head<3>() + f * Eigen::Vector3d(0.001, 0.002, -0.001);
  }
  second.prescribed_paths.push_back(path);
  second.damping = 0.3;
  scene.objects.push_back(second);
  scene.wind = {2.0, 1.0, -1.0};
  scene.aerodynamics = AerodynamicsLaw::kUnitNormal;
  return scene;
}

}  // namespace

const std::vector<std::string>& DerivativeSceneNames() {
  static const std::vector<std::string> kNames = {"side", "corners", "flag", "collider",
                                                  "two_objects"};
  return kNames;
}

Scene MakeDerivativeScene(const std::string& name, int resolution) {
  PresetOptions options;
  options.rows = options.cols = resolution;
  if (name == "collider") return ColliderScene(options);
  if (name == "two_objects") return TwoObjectScene(options);
  return MakePresetScene(ScenePresetFromName(name), options);
}

void EstimateEverything(ParameterMode mode, Scene* scene) {
  for (ClothObject& object : scene->objects) {
    object.mass_mode = object.stiffness_mode = mode;
    object.estimate_damping = object.estimate_drag = true;
    object.estimate_initial_velocity = object.estimate_initial_position = true;
    object.rest_length = RestLengths(object);
  }
  scene->estimate_wind = true;
}

void Perturb(unsigned seed, Scene* scene) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  const auto factor = [&] { return std::exp(0.2 * normal(generator)); };
  for (ClothObject& object : scene->objects) {
    for (double& m : object.mass) m *= factor();
    for (double& k : object.stiffness) k *= factor();
    object.damping *= factor();
    object.drag_coefficient *= factor();
    for (int i = 0; i < object.num_vertices(); ++i) {
      if (object.is_fixed[i]) continue;
      for (int c = 0; c < 3; ++c)
        object.velocities[3 * i + c] += 0.5 * normal(generator);
    }
  }
  for (double& w : scene->wind) w += 0.5 * normal(generator);
}

}  // namespace dpe::test
