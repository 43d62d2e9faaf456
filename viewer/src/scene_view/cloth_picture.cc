#include "scene_view/cloth_picture.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "scene_view/corner_coloring.h"

namespace dpe::viewer {
namespace {

using Edges = std::vector<std::array<int, 2>>;

// In order, as often as there are triangles that have them.
Edges SidesOf(const ClothObject& object) {
  Edges edges;
  for (const std::array<int, 3>& t : object.triangles) {
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

Edges EdgesOf(const ClothObject& object) {
  Edges edges = SidesOf(object);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

Edges BorderOf(const ClothObject& object) {
  const Edges sides = SidesOf(object);
  Edges border;
  for (size_t k = 0; k < sides.size();) {
    const size_t first = k;
    while (k < sides.size() && sides[k] == sides[first]) ++k;
    if (k == first + 1) border.push_back(sides[first]);
  }
  return border;
}

bool IsKnown(const Eigen::VectorXd& positions, int vertex) {
  return std::isfinite(positions[3 * vertex]);
}

}  // namespace

glm::vec3 ToPoint(const Eigen::Vector3d& position) {
  if (!position.allFinite()) return glm::vec3(0.0f);
  return {static_cast<float>(position.x()), static_cast<float>(position.y()),
          static_cast<float>(position.z())};
}

std::vector<glm::vec3> ToPoints(const Eigen::VectorXd& positions) {
  std::vector<glm::vec3> points(positions.size() / 3);
  for (size_t i = 0; i < points.size(); ++i) {
    points[i] = ToPoint(positions.segment<3>(3 * static_cast<Eigen::Index>(i)));
  }
  return points;
}

std::vector<glm::vec3> VertexNormals(const std::vector<glm::vec3>& positions,
                                     const std::vector<std::uint32_t>& triangles) {
  std::vector<glm::vec3> normals(positions.size(), glm::vec3(0.0f));
  for (size_t t = 0; t + 2 < triangles.size(); t += 3) {
    const std::uint32_t a = triangles[t], b = triangles[t + 1], c = triangles[t + 2];
    // Twice the area long.
    const glm::vec3 normal =
        glm::cross(positions[b] - positions[a], positions[c] - positions[a]);
    for (const std::uint32_t vertex : {a, b, c}) normals[vertex] += normal;
  }
  for (glm::vec3& normal : normals) {
    const float length = glm::length(normal);
    normal = length > 0.0f ? normal / length : glm::vec3(0.0f, 1.0f, 0.0f);
  }
  return normals;
}

ClothShape::ClothShape(const ClothObject& object)
    : object_(object),
      rest_lengths_(RestLengths(object)),
      edges_(EdgesOf(object)),
      border_(BorderOf(object)) {
  CornerColoring coloring = ColorCorners(object.triangles, object.num_vertices());
  auto topology = std::make_shared<Topology>();
  topology->triangles.reserve(3 * coloring.triangles.size());
  for (const std::array<std::uint32_t, 3>& t : coloring.triangles) {
    topology->triangles.insert(topology->triangles.end(), t.begin(), t.end());
  }
  topology->corners = std::move(coloring.corners);
  topology_ = std::move(topology);
  copies_ = std::move(coloring.copies);
}

Surface ClothShape::MakeSurface(const Eigen::VectorXd& positions,
                                std::vector<glm::vec4> colors) const {
  Surface surface;
  surface.topology = topology_;
  if (!positions.allFinite()) {
    auto seen = std::make_shared<Topology>();
    seen->corners = topology_->corners;
    for (size_t t = 0; t < object_.triangles.size(); ++t) {
      const auto& [a, b, c] = object_.triangles[t];
      if (!IsKnown(positions, a) || !IsKnown(positions, b) || !IsKnown(positions, c)) {
        continue;
      }
      const auto begin = topology_->triangles.begin() + 3 * static_cast<long>(t);
      seen->triangles.insert(seen->triangles.end(), begin, begin + 3);
    }
    surface.topology = std::move(seen);
  }
  surface.positions = ToPoints(positions);
  surface.normals = Normals(surface.positions, *surface.topology);
  surface.colors = std::move(colors);
  for (const int vertex : copies_) {
    surface.positions.push_back(surface.positions[vertex]);
    surface.normals.push_back(surface.normals[vertex]);
    surface.colors.push_back(surface.colors[vertex]);
  }
  return surface;
}

std::vector<glm::vec3> ClothShape::Normals(const std::vector<glm::vec3>& positions,
                                           const Topology& topology) const {
  if (copies_.empty()) return VertexNormals(positions, topology.triangles);
  // A copy has no normal of its own.
  std::vector<std::uint32_t> triangles = topology.triangles;
  for (std::uint32_t& vertex : triangles) {
    if (vertex >= positions.size()) vertex = copies_[vertex - positions.size()];
  }
  return VertexNormals(positions, triangles);
}

Lines ClothShape::MakeLines(const Eigen::VectorXd& positions,
                            const std::vector<std::array<int, 2>>& pairs,
                            const std::vector<glm::vec4>& colors) {
  Lines lines;
  lines.positions.reserve(2 * pairs.size());
  lines.colors.reserve(2 * pairs.size());
  for (size_t p = 0; p < pairs.size(); ++p) {
    const auto& [a, b] = pairs[p];
    if (!IsKnown(positions, a) || !IsKnown(positions, b)) continue;
    const glm::vec4& color = colors.size() == 1 ? colors[0] : colors[p];
    for (const int vertex : {a, b}) {
      lines.positions.push_back(ToPoint(positions.segment<3>(3 * vertex)));
      lines.colors.push_back(color);
    }
  }
  return lines;
}

}  // namespace dpe::viewer
