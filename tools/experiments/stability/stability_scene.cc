#include "experiments/stability/stability_scene.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <utility>

#include "dpe/engine/cloth_builder.h"

namespace dpe::experiments {
namespace {

constexpr int kSide = 6;           // vertices
constexpr double kStep = 0.002;    // s
constexpr double kDamping = 0.01;  // 1/s

// A power of two, so that positions along the way are exact numbers.
constexpr double kExactStep = 1.0 / 128.0;  // s

Scene BaseScene(int side) {
  PresetOptions options;
  options.rows = options.cols = side;
  options.material.damping = kDamping;
  Scene scene = MakePresetScene(ScenePreset::kSide, options);
  scene.delta = kStep;
  scene.wind = {2.0, 0.5, 1.0};
  // So that nothing rests on symmetry.
  ClothObject& cloth = scene.objects[0];
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-0.1, 0.1);
  for (double& v : cloth.velocities) v = uniform(random);
  for (int i = 0; i < cloth.num_vertices(); ++i) {
    if (cloth.is_fixed[i]) cloth.velocities.segment<3>(3 * i).setZero();
  }
  return scene;
}

// Two or three vertices of 1 kg without gravity; all but the last are fixed, and the
// last one moves at the given velocity (m/s).
Scene PointScene(const std::vector<Eigen::Vector3d>& points,
                 const Eigen::Vector3d& velocity) {
  Scene scene;
  scene.title = "points";
  scene.delta = kExactStep;
  scene.gravity.setZero();
  ClothObject object;
  const int n = static_cast<int>(points.size());
  object.positions.resize(3 * n);
  for (int i = 0; i < n; ++i) object.positions.segment<3>(3 * i) = points[i];
  object.velocities.setZero(3 * n);
  object.velocities.tail<3>() = velocity;
  object.is_fixed.assign(n, 1);
  object.is_fixed.back() = 0;
  object.mass.setOnes(n);
  scene.objects.push_back(object);
  return scene;
}

void SetStiffness(double value, StabilityScene* s) {
  Eigen::VectorXd& k = s->scene.objects[0].stiffness;
  k *= value / k.maxCoeff();
}

void SetMass(double value, StabilityScene* s) {
  s->scene.objects[0].mass.setConstant(value);
}

void SetMassRatio(double value, StabilityScene* s) {
  Eigen::VectorXd& mass = s->scene.objects[0].mass;
  for (int i = 0; i < mass.size(); ++i) {
    const bool is_heavy = (i / kSide + i % kSide) % 2 == 0;
    mass[i] *= std::sqrt(is_heavy ? value : 1.0 / value);
  }
}

// As many steps as elsewhere, but no longer than the motion can be followed.
void SetDelta(double value, StabilityScene* s) {
  s->scene.delta = value;
  const double duration = value < 1.0 ? 2.0 : 5.0;  // s
  s->num_frames = 1 + std::min(100, static_cast<int>(std::lround(duration / value)));
  s->gradient_frames = std::min(s->num_frames, s->gradient_frames);
}

void SetDamping(double value, StabilityScene* s) {
  s->scene.objects[0].damping = value;
}

void SetWind(double value, StabilityScene* s) {
  s->scene.wind = value * Eigen::Vector3d(2.0, 0.5, 1.0).normalized();
}

void SetDrag(double value, StabilityScene* s) {
  s->scene.objects[0].drag_coefficient = value;
}

void SetShift(double value, StabilityScene* s) { s->shift.setConstant(value); }

// The free end of a spring flies past its fixed end, at a distance of `value`. At 0
// the spring has no stiffness, so that all methods arrive at the very place.
void SetCoincident(double value, StabilityScene* s) {
  s->scene = PointScene({{0.0, 0.0, 0.0}, {1.0, value, 0.0}}, {-8.0, 0.0, 0.0});
  ClothObject& object = s->scene.objects[0];
  object.springs = {{0, 1}};
  object.stiffness = Eigen::VectorXd::Constant(1, value == 0.0 ? 0.0 : 1.0);
  object.rest_length = Eigen::VectorXd::Constant(1, 1.0);
  s->num_frames = s->gradient_frames = 31;
}

// A vertex crosses the line through the other two of its triangle, at a distance of
// `value` out of the plane in which it moves.
void SetCollapse(double value, AerodynamicsLaw law, StabilityScene* s) {
  s->scene =
      PointScene({{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.5, 1.0, value}}, {0, -8.0, 0});
  s->scene.aerodynamics = law;
  ClothObject& object = s->scene.objects[0];
  object.triangles = {{0, 1, 2}};
  object.drag_coefficient = 1.0;
  s->num_frames = s->gradient_frames = 31;
}

// The springs are at rest at 1 / value times the cloth's size, and its vertices 1 mm
// off the plane, so that it is not left to rounding which way it buckles.
void SetCompression(double value, StabilityScene* s) {
  ClothObject& cloth = s->scene.objects[0];
  cloth.rest_length = RestLengths(cloth) / value;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1e-3, 1e-3);
  for (int i = 0; i < cloth.num_vertices(); ++i) {
    if (!cloth.is_fixed[i]) cloth.positions[3 * i + 1] += uniform(random);
  }
}

void SetFreeVertices(double value, StabilityScene* s) {
  ClothObject& cloth = s->scene.objects[0];
  const int n = cloth.num_vertices();
  const int count = static_cast<int>(value);
  for (int i = 0; i < n; ++i) {
    // One free vertex: in the middle. All but one: a corner is fixed.
    const bool is_free = count == 1 ? i == n / 2 + kSide / 2 : i > 0;
    cloth.is_fixed[i] = is_free ? 0 : 1;
    if (!is_free) cloth.velocities.segment<3>(3 * i).setZero();
  }
}

// A cloth of 3 x 3 vertices, damped enough to come to rest.
void SetFrames(double value, StabilityScene* s) {
  s->scene = BaseScene(3);
  s->scene.objects[0].damping = 0.1;
  s->num_frames = s->gradient_frames = static_cast<int>(value) + 1;
}

// A loose cloth falls at 1 m/s onto a collider of that stiffness, which its vertices
// reach one after the other from 0.03 s on: the tilted plane, and the sphere, whose top
// is below the four in the middle of the cloth but nearer to some of them.
void SetContact(double value, ColliderType type, StabilityScene* s) {
  ClothObject& cloth = s->scene.objects[0];
  UnpinAll(&cloth);
  for (int i = 0; i < cloth.num_vertices(); ++i) cloth.velocities[3 * i + 1] -= 1.0;
  Collider collider = SphereCollider({0.1, -2.918, 0.15}, 3.0);
  if (type == ColliderType::kPlane) {
    collider.type = ColliderType::kPlane;
    collider.position = {0.0, -0.15, 0.0};
    collider.rotation_degrees = {1.0, 0.0, 1.0};
  }
  collider.stiffness = value;
  s->scene.colliders = {collider};
  s->gradient_frames = 61;
}

struct AxisRule {
  StabilityAxis axis;
  std::function<void(double, StabilityScene*)> set;
};

std::vector<AxisRule> MakeRules() {
  const auto authored = AerodynamicsLaw::kAuthored;
  const auto unit = AerodynamicsLaw::kUnitNormal;
  return {
      {{"stiffness", "stiffness (N/m)", {1e-6, 1e-3, 1, 50, 1e3, 1e4, 1e6, 1e9}},
       SetStiffness},
      {{"mass", "mass of a vertex (kg)", {1e-6, 1e-4, 1e-2, 1, 1e3, 1e6}}, SetMass},
      {{"mass_ratio", "mass ratio of neighbours", {1e2, 1e4, 1e6}}, SetMassRatio},
      {{"delta", "step (s)", {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 3e-2, 0.1, 1}}, SetDelta},
      {{"damping", "damping (1/s)", {0, 0.1, 1, 10, 100, 1e4}}, SetDamping},
      {{"wind", "wind (m/s)", {0, 10, 100, 300, 1000}}, SetWind},
      {{"drag", "drag coefficient", {0, 1, 10, 100}}, SetDrag},
      {{"shift", "shift of the origin (m)", {1e3, 1e6}}, SetShift},
      {{"coincident", "least distance of two vertices (m)", {0, 1e-9, 1e-3}},
       SetCoincident},
      {{"collapse", "least height of a triangle, law authored (m)", {0, 1e-6}},
       [=](double v, StabilityScene* s) { SetCollapse(v, authored, s); }},
      {{"collapse_unit", "least height of a triangle, law unit_normal (m)", {0, 1e-6}},
       [=](double v, StabilityScene* s) { SetCollapse(v, unit, s); }},
      {{"compression", "initial size / rest size", {0.99, 0.9, 0.5}}, SetCompression},
      {{"free_vertices", "free vertices of 36", {1, 35}}, SetFreeVertices},
      {{"frames", "frames", {1000, 10000}}, SetFrames},
      {{"plane", "stiffness of a plane collider (N/m)", {1e3, 1e5, 1e7, 1e9}},
       [](double v, StabilityScene* s) { SetContact(v, ColliderType::kPlane, s); }},
      {{"sphere", "stiffness of a sphere collider (N/m)", {1e3, 1e6, 1e9}},
       [](double v, StabilityScene* s) { SetContact(v, ColliderType::kSphere, s); }},
  };
}

const std::vector<AxisRule>& Rules() {
  static const std::vector<AxisRule> rules = MakeRules();
  return rules;
}

}  // namespace

const std::vector<StabilityAxis>& StabilityAxes() {
  static const std::vector<StabilityAxis> axes = [] {
    std::vector<StabilityAxis> all;
    for (const AxisRule& rule : Rules()) all.push_back(rule.axis);
    return all;
  }();
  return axes;
}

StabilityScene MakeStabilityScene(const std::string& axis, double value) {
  for (const AxisRule& rule : Rules()) {
    if (rule.axis.name != axis) continue;
    StabilityScene result;
    result.scene = BaseScene(kSide);
    rule.set(value, &result);
    ApplySettings("nn", &result.scene);
    return result;
  }
  throw SceneError("axis: \"" + axis + "\" is not an axis of the stability experiment");
}

}  // namespace dpe::experiments
