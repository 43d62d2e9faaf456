#include "cloth_picture.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <set>
#include <utility>

namespace dpe::viewer {
namespace {

constexpr float kWidth = 2.0f;   // m
constexpr float kHeight = 1.5f;  // m

// The lower right corner is folded over towards +z, about a diagonal.
glm::vec3 Place(float u, float v) {
  const float ripple = 0.12f * std::sin(9.0f * u) * (1.2f - v);
  const glm::vec3 flat(kWidth * (u - 0.5f), 0.4f + kHeight * v, ripple);
  const float past_the_fold = u - v - 0.45f;
  if (past_the_fold <= 0) return flat;
  const glm::vec3 out(0.75f * kWidth / kHeight, -1.0f, 0.0f);
  const glm::vec3 inward = -glm::normalize(out);
  const float over = 1.1f * past_the_fold;
  return flat + inward * over * 1.9f +
         glm::vec3(0, 0, 0.55f * over + 0.1f * over * over);
}

void AddSegment(Lines* lines, const glm::vec3& a, const glm::vec3& b,
                const glm::vec4& color) {
  lines->positions.insert(lines->positions.end(), {a, b});
  lines->colors.insert(lines->colors.end(), 2, color);
}

Lines Grid() {
  Lines grid;
  const glm::vec4 color(0.3f, 0.3f, 0.35f, 1.0f);
  for (int i = -5; i <= 5; ++i) {
    const float at = 0.4f * i;
    AddSegment(&grid, {at, 0, -2}, {at, 0, 2}, color);
    AddSegment(&grid, {-2, 0, at}, {2, 0, at}, color);
  }
  return grid;
}

Lines Axes() {
  Lines axes;
  axes.width = 3.0f;
  axes.on_top = true;
  AddSegment(&axes, {}, {0.5f, 0, 0}, {0.9f, 0.05f, 0.05f, 1});
  AddSegment(&axes, {}, {0, 0.5f, 0}, {0.05f, 0.7f, 0.05f, 1});
  AddSegment(&axes, {}, {0, 0, 0.5f}, {0.1f, 0.2f, 1.0f, 1});
  return axes;
}

}  // namespace

Camera LookAt(const glm::vec3& eye, const glm::vec3& target, float aspect) {
  Camera camera;
  camera.position = eye;
  camera.view = glm::lookAtRH(eye, target, glm::vec3(0, 1, 0));
  camera.projection = glm::perspectiveRH_ZO(glm::radians(45.0f), aspect, 0.05f, 50.0f);
  camera.projection[1][1] *= -1.0f;
  return camera;
}

std::vector<glm::vec3> Normals(const std::vector<glm::vec3>& positions,
                               const std::vector<std::uint32_t>& triangles) {
  std::vector<glm::vec3> normals(positions.size(), glm::vec3(0.0f));
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
    const glm::vec3& a = positions[triangles[i]];
    const glm::vec3 area =
        glm::cross(positions[triangles[i + 1]] - a, positions[triangles[i + 2]] - a);
    for (int corner = 0; corner < 3; ++corner) normals[triangles[i + corner]] += area;
  }
  for (glm::vec3& normal : normals) normal = glm::normalize(normal);
  return normals;
}

Surface WavySheet(int side) {
  Surface sheet;
  auto topology = std::make_shared<Topology>();
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const float u = static_cast<float>(column) / (side - 1);
      const float v = static_cast<float>(row) / (side - 1);
      sheet.positions.push_back(Place(u, v));
      sheet.colors.emplace_back(0.25f + 0.6f * u, 0.2f + 0.5f * v, 0.3f, 1.0f);
    }
  }
  for (int row = 0; row + 1 < side; ++row) {
    for (int column = 0; column + 1 < side; ++column) {
      const std::uint32_t a = row * side + column;
      const std::uint32_t up = side;
      topology->triangles.insert(topology->triangles.end(),
                                 {a, a + 1, a + up, a + 1, a + up + 1, a + up});
    }
  }
  sheet.normals = Normals(sheet.positions, topology->triangles);
  sheet.topology = std::move(topology);
  return sheet;
}

Lines Wireframe(const Surface& surface, const glm::vec4& color, float width) {
  Lines lines;
  lines.width = width;
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;  // each once
  const std::vector<std::uint32_t>& triangles = surface.topology->triangles;
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
    for (int edge = 0; edge < 3; ++edge) {
      edges.insert(std::minmax<std::uint32_t>(triangles[i + edge],
                                              triangles[i + (edge + 1) % 3]));
    }
  }
  for (const auto& [a, b] : edges) {
    AddSegment(&lines, surface.positions[a], surface.positions[b], color);
  }
  return lines;
}

Picture ClothPicture(int side, float aspect) {
  Picture picture;
  picture.camera = LookAt({1.4f, 1.7f, 3.6f}, {0, 0.95f, 0}, aspect);
  picture.surfaces.push_back(WavySheet(side));
  picture.lines = {Grid(),
                   Wireframe(picture.surfaces[0], {0.02f, 0.02f, 0.03f, 0.6f}, 1.0f),
                   Axes()};
  Points fixed;
  fixed.color = {0.9f, 0.3f, 0.05f, 1.0f};
  fixed.size = 10.0f;
  const std::vector<glm::vec3>& positions = picture.surfaces[0].positions;
  fixed.positions = {positions[side * (side - 1)], positions[side * side - 1]};
  picture.points.push_back(fixed);
  return picture;
}

}  // namespace dpe::viewer
