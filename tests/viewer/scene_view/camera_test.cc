// Cameras by where points land in the picture: x to the right, y down, depth 0 to 1.
#include "scene_view/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace dpe::viewer {
namespace {

glm::vec3 Project(const Camera& camera, const glm::vec3& point) {
  const glm::vec4 clip = camera.projection * camera.view * glm::vec4(point, 1.0f);
  return glm::vec3(clip) / clip.w;
}

OrbitCamera TestCamera() {
  OrbitCamera camera;
  camera.SetHome({{1.0f, 2.0f, -3.0f}, 2.0f});
  return camera;
}

TEST(CameraTest, ShowsTheBallWholeInWideAndHighWindows) {
  for (const int width : {200, 500, 1250}) {
    const OrbitCamera orbit = TestCamera();
    const Camera camera = orbit.Get(width, 500);
    float largest = 0.0f;
    for (int k = 0; k < 2000; ++k) {
      const float polar = 0.05f * k, azimuth = 2.4f * k;
      const glm::vec3 point =
          glm::vec3(1.0f, 2.0f, -3.0f) +
          2.0f * glm::vec3(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                           std::sin(polar) * std::sin(azimuth));
      const glm::vec3 at = Project(camera, point);
      largest = std::max({largest, std::abs(at.x), std::abs(at.y)});
      EXPECT_GT(at.z, 0.0f);
      EXPECT_LT(at.z, 1.0f);
    }
    EXPECT_LT(largest, 1.0f) << width;
    EXPECT_GT(largest, 0.9f) << width;
    EXPECT_NEAR(Project(camera, {1.0f, 2.0f, -3.0f}).x, 0.0f, 1e-5f);
  }
}

TEST(CameraTest, UpIsUpRightIsRightAndNearIsNear) {
  OrbitCamera orbit = TestCamera();
  orbit.SetHomeAngles(0.0f, 0.0f);  // looks along -z
  const Camera camera = orbit.Get(900, 600);
  const glm::vec3 center = orbit.target();
  EXPECT_LT(Project(camera, center + glm::vec3(0, 1, 0)).y, -0.1f);  // Vulkan: y down
  EXPECT_GT(Project(camera, center + glm::vec3(1, 0, 0)).x, 0.1f);
  EXPECT_LT(Project(camera, center + glm::vec3(0, 0, 1)).z, Project(camera, center).z);
  EXPECT_NEAR(glm::distance(camera.position, center), orbit.distance(), 1e-4f);
  EXPECT_GT(camera.position.z, center.z);
}

TEST(CameraTest, TheClothFollowsThePointer) {
  OrbitCamera orbit = TestCamera();
  const glm::vec3 near_point =
      orbit.target() + 0.5f * (orbit.Get(600, 600).position - orbit.target()) /
                           glm::distance(orbit.Get(600, 600).position, orbit.target());
  orbit.Orbit(30.0f, 0.0f, 600.0f);
  EXPECT_GT(Project(orbit.Get(600, 600), near_point).x, 0.01f);  // went right
  orbit.Reset();
  orbit.Orbit(0.0f, 30.0f, 600.0f);
  EXPECT_GT(Project(orbit.Get(600, 600), near_point).y, 0.01f);  // went down
  orbit.Reset();
  const glm::vec3 center = orbit.target();
  orbit.Pan(60.0f, -90.0f, 600.0f);
  const glm::vec3 at = Project(orbit.Get(600, 600), center);
  // Exactly as far as the pointer: 60 of 300 pixels from the middle.
  EXPECT_NEAR(at.x, 0.2f, 1e-4f);
  EXPECT_NEAR(at.y, -0.3f, 1e-4f);
}

TEST(CameraTest, KeepsClearOfWhatIsCovered) {
  const OrbitCamera orbit = TestCamera();
  const Camera camera = orbit.Get(1000, 600, 300);
  // 650 of 1000 pixels from the left.
  EXPECT_NEAR(Project(camera, orbit.target()).x, 0.3f, 1e-5f);
  EXPECT_NEAR(Project(camera, orbit.target()).y, 0.0f, 1e-5f);
}

TEST(CameraTest, ZoomFrameAndReset) {
  OrbitCamera orbit = TestCamera();
  const float distance = orbit.distance(), yaw = orbit.yaw();
  orbit.Zoom(1.0f);
  EXPECT_NEAR(orbit.distance(), 0.9f * distance, 1e-4f);
  orbit.Zoom(-1.0f);
  EXPECT_NEAR(orbit.distance(), distance, 1e-4f);
  orbit.Zoom(1e6f);
  EXPECT_GT(orbit.distance(), 0.0f);
  orbit.Orbit(100.0f, 1e6f, 600.0f);
  EXPECT_LT(orbit.pitch(), 1.5708f);  // short of the pole
  orbit.Frame({{0.0f, 0.0f, 0.0f}, 4.0f});
  EXPECT_NEAR(orbit.distance(), 2.0f * distance, 1e-4f);
  EXPECT_NE(orbit.yaw(), yaw);  // looks from where it looked
  orbit.Reset();
  EXPECT_EQ(orbit.yaw(), yaw);
  EXPECT_EQ(orbit.distance(), distance);
  EXPECT_EQ(orbit.target(), glm::vec3(1.0f, 2.0f, -3.0f));
}

}  // namespace
}  // namespace dpe::viewer
