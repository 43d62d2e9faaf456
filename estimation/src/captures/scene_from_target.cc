#include "dpe/estimation/scene_from_target.h"

#include <algorithm>

#include "dpe/engine/scene_io.h"
#include "dpe/estimation/rest_shape.h"

namespace dpe {
namespace {

// What a vertex may move, as a fraction of the cloth's extent, and still be pinned:
// files round positions.
constexpr double kStill = 1e-5;

// Of the vertices in faces, those that every frame shows where the first one does.
std::vector<int> StillVertices(const Capture& capture, const ClothObject& cloth) {
  std::vector<int> vertex_of(capture.mesh.in_a_face.size(), -1);
  int count = 0;
  for (size_t v = 0; v < vertex_of.size(); ++v) {
    if (capture.mesh.in_a_face[v]) vertex_of[v] = count++;
  }
  const Eigen::Map<const Eigen::Matrix3Xd> first(cloth.positions.data(), 3, count);
  const double limit =
      kStill * (first.rowwise().maxCoeff() - first.rowwise().minCoeff()).norm();
  std::vector<char> is_still(count, 1);
  for (const CaptureSample& sample : capture.samples) {
    const int v = vertex_of[sample.marker];
    if (v >= 0 && (sample.position - first.col(v)).norm() > limit) is_still[v] = 0;
  }
  std::vector<int> still;
  for (int v = 0; v < count; ++v) {
    if (is_still[v]) still.push_back(v);
  }
  return still;
}

}  // namespace

Scene SceneFromTarget(const std::string& path, const TargetOptions& target,
                      const SceneFromTargetOptions& options) {
  Capture capture = ReadCapture(path, target.capture);
  if (!(target.capture.rate > 0.0) && capture.time_unit == Capture::TimeUnit::kFrames) {
    throw SceneError(path +
                     ": does not say how long a frame is, and there is no scene that "
                     "does; accepted is a rate (frames per second) > 0");
  }
  Scene scene;
  scene.title = path;
  scene.delta = 1.0 / target.capture.rate;
  // Of the two laws the one whose coefficient does not depend on how fine the mesh is.
  scene.aerodynamics = AerodynamicsLaw::kUnitNormal;
  scene.integration_method = options.integration_method;
  scene.steps_per_frame = options.steps_per_frame;
  ToSceneUnits(target.capture, scene.delta, &capture);
  Eigen::VectorXd rest;
  if (!target.rest_shape.empty()) {
    rest = ReadRestShape(target.rest_shape, target.capture.scale, capture);
  }
  ClothObject cloth = BuildClothFromCapture(capture, rest, options.material);
  if (!options.without_pins) {
    PinVertices(options.pins.empty() ? StillVertices(capture, cloth) : options.pins,
                &cloth);
  }
  scene.objects.push_back(std::move(cloth));
  scene.num_frames = 0;
  for (const CaptureSample& sample : capture.samples) {
    scene.num_frames =
        std::max(scene.num_frames, static_cast<int>(sample.time + 0.5) + 1);
  }
  ValidateScene(scene, path, nullptr);
  return scene;
}

}  // namespace dpe
