// Recovers three stiffnesses and the damping of a cloth from one number per marker and
// frame: how far the marker is from a known plane. A depth camera measures such a thing
// (its plane stands through the camera, across its axis), and so does a laser sheet.
//
// Exit code 0: the parameters that made the measurements were recovered.
#include <cstdio>
#include <exception>
#include <memory>
#include <utility>
#include <vector>

#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/simulator.h"
#include "dpe/estimation/autodiff_trajectory_cost.h"
#include "dpe/estimation/observations.h"
#include "example_support.h"

namespace dpe::examples {
namespace {

constexpr int kNumFrames = 60;
constexpr double kSigma = 0.005;  // m, of a measurement
constexpr double kTolerance = 1e-6;

// The points x with normal . x = offset.
struct Plane {
  Eigen::Vector3d normal;  // of length 1, towards positive distances
  double offset = 0.0;     // m
};

// [point_to_plane]
// Simulated minus measured distance of a marker to a plane, in standard deviations:
//
//   r = (n . (w0 x0 + w1 x1 + w2 x2) - offset - measured) / sigma
//
// with the barycentric coordinates w of the marker in the triangle x0, x1, x2.
struct PointToPlane {
  template <typename T>
  bool operator()(const T* corners, T* residual) const {
    T distance(-plane.offset);
    for (int i = 0; i < 3; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        distance += marker.weights[i] * plane.normal[axis] * corners[3 * i + axis];
      }
    }
    residual[0] = (distance - measured) / sigma;
    return true;
  }

  Marker marker;
  Plane plane;
  double measured;  // m
  double sigma;     // m
};
// [point_to_plane]

// One marker in every fifth triangle, away from its corners and its middle.
std::vector<Marker> MakeMarkers(const ClothObject& cloth) {
  std::vector<Marker> markers;
  for (size_t t = 0; t < cloth.triangles.size(); t += 5) {
    Marker marker;
    marker.vertices.assign(cloth.triangles[t].begin(), cloth.triangles[t].end());
    marker.weights = {0.5, 0.3, 0.2};
    markers.push_back(marker);
  }
  return markers;
}

double Distance(const Marker& marker, const Plane& plane, const Trajectory& trajectory,
                int frame) {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    x += marker.weights[i] * trajectory.positions[marker.object].col(frame).segment<3>(
                                 3 * marker.vertices[i]);
  }
  return plane.normal.dot(x) - plane.offset;
}

// [costs]
// One residual per marker and frame: a robust loss, if one is wanted, then judges each
// measurement by itself.
TrajectoryCosts MakeCosts(const Scene& scene, const std::vector<Marker>& markers,
                          const Plane& plane, const Trajectory& measured) {
  TrajectoryCosts costs;
  for (int frame = 1; frame < kNumFrames; ++frame) {
    for (const Marker& marker : markers) {
      const PointToPlane residual = {marker, plane,
                                     Distance(marker, plane, measured, frame), kSigma};
      // <1 residual, 3 vertices>
      costs.push_back(MakeAutodiffCost<1, 3>(
          scene, residual, {{marker.object, frame, marker.vertices}}));
    }
  }
  return costs;
}
// [costs]

bool Run() {
  PresetOptions preset;
  preset.rows = preset.cols = 8;
  Scene scene = MakePresetScene(ScenePreset::kSide, preset);
  ApplySettings("nR", &scene);  // one stiffness for stretch, shear and bend each
  scene.objects[0].estimate_damping = true;
  const ParameterLayout layout(scene);
  const Eigen::VectorXd truth = layout.Extract(scene);
  layout.Insert(truth, &scene);  // the same stiffness in every spring of a group

  const Trajectory measured = Simulator(scene).Simulate(kNumFrames);
  const std::vector<Marker> markers = MakeMarkers(scene.objects[0]);
  const Plane plane = {Eigen::Vector3d(1.0, 0.4, 0.2).normalized(), -6.0};
  std::printf("%zu markers, %d frames: one distance each\n", markers.size(),
              kNumFrames - 1);

  // From here on the scene does not know the true values any more.
  Eigen::VectorXd start = Eigen::VectorXd::Constant(layout.size(), 10.0);  // N/m
  start[layout.size() - 1] = 1.0;                                          // 1/s
  layout.Insert(start, &scene);

  // [fit]
  TrajectoryCosts costs = MakeCosts(scene, markers, plane, measured);
  if (!CheckAndPrint(*costs.back(), measured)) return false;
  TrajectoryProblem problem(scene, std::move(costs));
  problem.set_coordinates(problem.evaluator()->map().ToCoordinates(start));
  const Eigen::VectorXd found = Minimize(&problem);
  // [fit]
  return PrintComparison(layout, truth, start, found, kTolerance);
}

}  // namespace
}  // namespace dpe::examples

int main() {
  try {
    return dpe::examples::Run() ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "marker_to_plane: error: %s\n", error.what());
    return 1;
  }
}
