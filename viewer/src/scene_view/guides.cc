#include "scene_view/guides.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "scene_view/cloth_picture.h"
#include "scene_view/collider_shapes.h"

namespace dpe::viewer {
namespace {

constexpr int kGridHalf = 10;  // squares from the middle to the edge
const glm::vec4 kGridColor(0.16f, 0.18f, 0.21f, 1.0f);
const glm::vec4 kWindColor(0.10f, 0.65f, 0.80f, 1.0f);

void AddLine(const glm::vec3& from, const glm::vec3& to, const glm::vec4& from_color,
             const glm::vec4& to_color, Lines* lines) {
  lines->positions.insert(lines->positions.end(), {from, to});
  lines->colors.insert(lines->colors.end(), {from_color, to_color});
}

struct Box {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e300);
  Eigen::Vector3d high = Eigen::Vector3d::Constant(-1e300);
};

Box BoxAbout(const Scene& scene) {
  Box box;
  for (const ClothObject& object : scene.objects) {
    for (int i = 0; i < object.num_vertices(); ++i) {
      box.low = box.low.cwiseMin(object.positions.segment<3>(3 * i));
      box.high = box.high.cwiseMax(object.positions.segment<3>(3 * i));
    }
  }
  return box;
}

}  // namespace

Ball BallAbout(const Scene& scene) {
  Box box = BoxAbout(scene);
  const Eigen::Vector3d extent = box.high - box.low;
  box.low.y() -= 0.6 * std::max(extent.x(), extent.z());
  Ball ball;
  ball.center = ToPoint(0.5 * (box.low + box.high));
  ball.radius = std::max(static_cast<float>(0.5 * (box.high - box.low).norm()), 1e-4f);
  return ball;
}

double TopOf(const Scene& scene) { return BoxAbout(scene).high.y(); }

double GroundLevel(const Scene& scene) {
  std::optional<double> level;
  for (const Collider& collider : scene.colliders) {
    if (collider.type != ColliderType::kPlane) continue;
    if (PlaneColliderNormal(collider).y() < 0.999) continue;
    level = std::max(level.value_or(-1e300), collider.position.y());
  }
  if (level) return *level;
  const Box box = BoxAbout(scene);
  const Eigen::Vector3d extent = box.high - box.low;
  return box.low.y() - 1.15 * std::max(extent.x(), extent.z());
}

double GridSpacing(const Ball& ball) {
  const double least = 0.15 * ball.radius;
  double spacing = std::pow(10.0, std::floor(std::log10(least)));
  for (const double step : {2.0, 2.5, 2.0}) {  // 1, 2, 5, 10
    if (spacing >= least) break;
    spacing *= step;
  }
  return spacing;
}

Lines GroundGrid(const Ball& ball, double level, const glm::vec4& background) {
  Lines grid;
  const auto spacing = static_cast<float>(GridSpacing(ball));
  const auto y = static_cast<float>(level);
  const float half = spacing * kGridHalf;
  // Grid lines lie at whole multiples of the spacing.
  const float cx = spacing * std::round(ball.center.x / spacing);
  const float cz = spacing * std::round(ball.center.z / spacing);
  for (int k = -kGridHalf; k <= kGridHalf; ++k) {
    const float at = spacing * static_cast<float>(k);
    const float strength =
        1.0f - std::abs(static_cast<float>(k)) / static_cast<float>(kGridHalf);
    const glm::vec4 bright = background + strength * (kGridColor - background);
    for (const float side : {-half, half}) {
      AddLine({cx + at, y, cz}, {cx + at, y, cz + side}, bright, background, &grid);
      AddLine({cx, y, cz + at}, {cx + side, y, cz + at}, bright, background, &grid);
    }
  }
  return grid;
}

Lines Axes(const Ball& ball, double level) {
  const auto spacing = static_cast<float>(GridSpacing(ball));
  const glm::vec3 origin(
      spacing * std::round((ball.center.x - 0.7f * ball.radius) / spacing),
      static_cast<float>(level) + 2e-3f * ball.radius,
      spacing * std::round((ball.center.z + 0.7f * ball.radius) / spacing));
  Lines axes;
  axes.width = 3.0f;
  for (int k = 0; k < 3; ++k) {
    glm::vec3 direction(0.0f);
    direction[k] = spacing;
    glm::vec4 color(0.06f, 0.06f, 0.06f, 1.0f);
    color[k] = 0.75f;
    if (k == 2) color.y = 0.2f;  // blue alone is dark
    AddLine(origin, origin + direction, color, color, &axes);
  }
  return axes;
}

Lines WindArrow(const Ball& ball, double top, const Eigen::Vector3d& wind) {
  Lines arrow;
  const double speed = wind.norm();
  if (!(speed > 0.0)) return arrow;
  arrow.width = 3.0f;
  const glm::vec3 along = ToPoint(wind / speed);
  const auto strength = static_cast<float>(speed / (speed + 5.0));
  const float length = ball.radius * (0.2f + 0.6f * strength);
  glm::vec3 middle = ball.center;
  middle.y = std::max(middle.y + 0.6f * ball.radius,
                      static_cast<float>(top) + 0.1f * ball.radius);
  const glm::vec3 tip = middle + 0.5f * length * along;
  AddLine(middle - 0.5f * length * along, tip, kWindColor, kWindColor, &arrow);
  // The head: four lines, so that it looks like one from everywhere.
  const glm::vec3 other =
      std::abs(along.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
  const glm::vec3 u = glm::normalize(glm::cross(along, other));
  const glm::vec3 v = glm::cross(along, u);
  const float head = 0.08f * ball.radius;
  for (const glm::vec3& side : {u, -u, v, -v}) {
    AddLine(tip, tip - 2.0f * head * along + head * side, kWindColor, kWindColor,
            &arrow);
  }
  return arrow;
}

}  // namespace dpe::viewer
