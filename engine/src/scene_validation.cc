// What is an error and what a warning: an error is what has no motion, or one that the
// author cannot have meant (a negative mass, a spring without length, a triangle
// without area). A warning is what the simulation takes at face value but that is often
// a slip: unknown keys, springs given twice, free vertices without a spring, an
// estimated quantity or a wind that nothing feels, a path that does not start at its
// vertex.
#include <string>
#include <vector>

#include "dpe/engine/scene_io.h"
#include "io/number_text.h"
#include "validation/collider_validation.h"
#include "validation/object_validation.h"
#include "validation/report.h"

namespace dpe {
namespace {

std::string ObjectPath(size_t i) { return "objects[" + std::to_string(i) + "]"; }

void CheckCounts(const Scene& scene, const ValidationReport& report) {
  if (scene.num_frames < 1) {
    report.Fail("optimizationIterations", std::to_string(scene.num_frames),
                "a number of frames >= 1");
  }
  if (scene.steps_per_frame < 1) {
    report.Fail("forwardSubSteps", std::to_string(scene.steps_per_frame),
                "a number of steps >= 1");
  }
  if (scene.objects.empty()) {
    report.Fail("objects", "an empty array", "at least one cloth");
  }
}

void CheckScalars(const Scene& scene, const ValidationReport& report) {
  report.RequirePositive("delta", scene.delta, "a finite length of a frame > 0 s");
  report.RequirePositive("tolerance", scene.tolerance, "a finite number > 0");
  report.RequireFinite("windVel", scene.wind);
  report.RequireFinite("gravity", scene.gravity);
  if (scene.solver != "auto" && scene.solver != "cholesky" && scene.solver != "cg") {
    report.Fail("solver", "\"" + scene.solver + "\"",
                "\"auto\", \"cholesky\" or \"cg\"");
  }
}

bool FeelsWind(const ClothObject& object) {
  return !object.triangles.empty() &&
         (object.drag_coefficient > 0.0 || object.estimate_drag);
}

void WarnOfMissingInfluence(const Scene& scene, const ValidationReport& report) {
  bool any_feels_wind = false;
  for (size_t i = 0; i < scene.objects.size(); ++i) {
    const ClothObject& object = scene.objects[i];
    any_feels_wind |= FeelsWind(object);
    if (object.triangles.empty() && object.estimate_drag) {
      report.Warn(ObjectPath(i) + ".estimate.dragCoefficient",
                  "the object has no triangles, so drag has no influence");
    }
    if (object.springs.empty() && object.stiffness_mode != ParameterMode::kFixed) {
      report.Warn(ObjectPath(i) + ".optimizationSettings",
                  "the object has no springs whose stiffness could be estimated");
    }
  }
  if (any_feels_wind) return;
  if (scene.estimate_wind) {
    report.Warn("estimate.wind",
                "no object feels it: none has both triangles and drag");
  } else if (!scene.wind.isZero(0.0)) {
    report.Warn("windVel", "no object feels it: none has both triangles and drag");
  }
}

void WarnOfJumps(const Scene& scene, const ValidationReport& report) {
  constexpr double kJump = 1e-6;  // m
  for (size_t i = 0; i < scene.objects.size(); ++i) {
    const ClothObject& object = scene.objects[i];
    for (size_t p = 0; p < object.prescribed_paths.size(); ++p) {
      const PrescribedPath& path = object.prescribed_paths[p];
      const Eigen::Vector3d rest = object.positions.segment<3>(3 * path.vertex);
      const double distance = (path.positions.col(0) - rest).norm();
      if (distance <= kJump) continue;
      report.Warn(
          ObjectPath(i) + ".prescribedPaths[" + std::to_string(p) + "].positions[0]",
          "lies " + NumberText(distance) + " m from the vertex in vertPos");
    }
  }
}

}  // namespace

void ValidateScene(const Scene& scene, const std::string& name,
                   std::vector<std::string>* warnings) {
  const ValidationReport report(name, warnings);
  CheckCounts(scene, report);
  CheckScalars(scene, report);
  for (size_t i = 0; i < scene.objects.size(); ++i) {
    ValidateObject(scene.objects[i], ObjectPath(i), report);
  }
  ValidateColliders(scene.colliders, report);
  WarnOfMissingInfluence(scene, report);
  WarnOfJumps(scene, report);
}

}  // namespace dpe
