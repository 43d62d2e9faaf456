#include "scene_view/collider_shapes.h"

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <utility>

#include "scene_view/cloth_picture.h"

namespace dpe::viewer {
namespace {

constexpr int kRings = 24, kSegments = 48;
const glm::vec4 kSphereColor(0.30f, 0.16f, 0.09f, 1.0f);
const glm::vec4 kPlaneColor(0.13f, 0.14f, 0.16f, 1.0f);

Surface Sphere(const Collider& collider) {
  constexpr float kPi = 3.14159265f;
  const glm::vec3 center = ToPoint(collider.position);
  const auto radius = static_cast<float>(0.5 * collider.scale.x());
  Surface surface;
  auto topology = std::make_shared<Topology>();
  for (int i = 0; i <= kRings; ++i) {
    const float polar = kPi * static_cast<float>(i) / kRings;
    for (int j = 0; j <= kSegments; ++j) {
      const float azimuth = 2.0f * kPi * static_cast<float>(j) / kSegments;
      const glm::vec3 normal(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                             std::sin(polar) * std::cos(azimuth));
      surface.positions.push_back(center + radius * normal);
      surface.normals.push_back(normal);
      surface.colors.push_back(kSphereColor);
      if (i == kRings || j == kSegments) continue;
      const std::uint32_t a = i * (kSegments + 1) + j, b = a + kSegments + 1;
      for (const std::uint32_t vertex : {a, b, a + 1, a + 1, b, b + 1}) {
        topology->triangles.push_back(vertex);
      }
    }
  }
  surface.topology = std::move(topology);
  return surface;
}

Surface Plane(const Collider& collider, const Ball& ball) {
  const Eigen::Vector3d normal = PlaneColliderNormal(collider);
  const Eigen::Vector3d center(ball.center.x, ball.center.y, ball.center.z);
  const Eigen::Vector3d foot = center - normal.dot(center - collider.position) * normal;
  const Eigen::Vector3d side = normal.unitOrthogonal() * 2.0 * ball.radius;
  const Eigen::Vector3d other = normal.cross(side);
  Surface surface;
  for (const auto& [s, t] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
    surface.positions.push_back(ToPoint(foot + s * side + t * other));
    surface.normals.push_back(ToPoint(normal));
    surface.colors.push_back(kPlaneColor);
  }
  auto topology = std::make_shared<Topology>();
  topology->triangles = {0, 1, 2, 0, 2, 3};
  surface.topology = std::move(topology);
  return surface;
}

}  // namespace

Eigen::Vector3d PlaneColliderNormal(const Collider& collider) {
  const Eigen::Vector3d radians = collider.rotation_degrees * (EIGEN_PI / 180.0);
  return Eigen::AngleAxisd(radians.y(), Eigen::Vector3d::UnitY()) *
         (Eigen::AngleAxisd(radians.x(), Eigen::Vector3d::UnitX()) *
          (Eigen::AngleAxisd(radians.z(), Eigen::Vector3d::UnitZ()) *
           Eigen::Vector3d::UnitY()));
}

Surface ColliderSurface(const Collider& collider, const Ball& ball) {
  return collider.type == ColliderType::kSphere ? Sphere(collider)
                                                : Plane(collider, ball);
}

}  // namespace dpe::viewer
