#include "dpe/engine/cloth_builder.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "io/number_text.h"

namespace dpe {
namespace {

// More than a scene file can hold, and a typing error: 1000 x 1000 is a large cloth.
constexpr std::int64_t kMaxVertices = 1'000'000;

// The edge rule: one record per pair of vertices that some triangle connects.
struct Edge {
  int spring = -1;
  int opposite = -1;  // vertex opposite the edge in the first of its triangles
  double volume = 0.0;
  bool is_longest = true;  // of every triangle it belongs to
};

Eigen::Vector3d Point(const Eigen::VectorXd& positions, int vertex) {
  return positions.segment<3>(3 * vertex);
}

void RequireNotNegative(const char* what, double value) {
  if (std::isfinite(value) && value >= 0.0) return;
  throw SceneError(std::string("cloth: ") + what + " " + NumberText(value) +
                   " is not accepted; expected a finite number >= 0");
}

void CheckMaterial(const ClothMaterial& material) {
  RequireNotNegative("traction stiffness", material.traction_stiffness);
  RequireNotNegative("bending stiffness", material.bending_stiffness);
  if (!std::isfinite(material.shear_stiffness)) {
    RequireNotNegative("shear stiffness", material.shear_stiffness);
  }
  RequireNotNegative("damping", material.damping);
  RequireNotNegative("drag coefficient", material.drag_coefficient);
  if (!(material.density > 0.0) || !std::isfinite(material.density)) {
    throw SceneError("cloth: density " + NumberText(material.density) +
                     " is not accepted; expected a finite number > 0 (kg/m^2)");
  }
}

std::string TriangleName(const TriangleMesh& mesh, size_t t) {
  const std::array<int, 3>& v = mesh.triangles[t];
  return "mesh: triangle " + std::to_string(t) + " (vertices " + std::to_string(v[0]) +
         ", " + std::to_string(v[1]) + ", " + std::to_string(v[2]) + ")";
}

// Area of triangle `t`, m^2.
double CheckedArea(const TriangleMesh& mesh, size_t t) {
  const int num_vertices = static_cast<int>(mesh.positions.size() / 3);
  for (int v : mesh.triangles[t]) {
    if (v < 0 || v >= num_vertices) {
      throw SceneError(TriangleName(mesh, t) + ": expected vertex indices from 0 to " +
                       std::to_string(num_vertices - 1));
    }
  }
  const auto [a, b, c] = mesh.triangles[t];
  const Eigen::Vector3d ab = Point(mesh.positions, b) - Point(mesh.positions, a);
  const Eigen::Vector3d ac = Point(mesh.positions, c) - Point(mesh.positions, a);
  const double area = ab.cross(ac).norm() / 2.0;
  const double scale = std::max(ab.squaredNorm(), ac.squaredNorm());
  if (!(area > 1e-12 * scale) || !std::isfinite(area)) {
    throw SceneError(TriangleName(mesh, t) + " has no area");
  }
  return area;
}

// Collects springs, their kind and their `vol` by the construction rule.
class SpringBuilder {
 public:
  SpringBuilder(const TriangleMesh& mesh, ClothObject* cloth)
      : positions_(mesh.positions), cloth_(cloth) {}

  void AddTriangle(const std::array<int, 3>& t, double area) {
    const double longest =
        std::max({Length(t[0], t[1]), Length(t[0], t[2]), Length(t[1], t[2])});
    VisitEdge(t[0], t[1], t[2], area, longest);
    VisitEdge(t[0], t[2], t[1], area, longest);
    VisitEdge(t[1], t[2], t[0], area, longest);
  }

  // Kinds and stiffnesses, once all triangles have been added.
  void Finish(const ClothMaterial& material) {
    const double shear = material.shear_stiffness < 0.0 ? material.traction_stiffness
                                                        : material.shear_stiffness;
    cloth_->spring_kind.assign(cloth_->springs.size(), SpringKind::kBend);
    for (const auto& entry : edges_) {
      const Edge& edge = entry.second;
      cloth_->spring_kind[edge.spring] =
          edge.is_longest ? SpringKind::kShear : SpringKind::kStretch;
      volumes_[edge.spring] = edge.volume;
    }
    cloth_->stiffness.resize(cloth_->num_springs());
    for (int s = 0; s < cloth_->num_springs(); ++s) {
      const double modulus =
          cloth_->spring_kind[s] == SpringKind::kBend    ? material.bending_stiffness
          : cloth_->spring_kind[s] == SpringKind::kShear ? shear
                                                         : material.traction_stiffness;
      const double length = Length(cloth_->springs[s][0], cloth_->springs[s][1]);
      cloth_->stiffness[s] = modulus * volumes_[s] / (length * length);
    }
  }

 private:
  double Length(int a, int b) const {
    return (Point(positions_, a) - Point(positions_, b)).norm();
  }

  int Append(int a, int b, double volume) {
    if (!(Length(a, b) > 0.0)) {
      throw SceneError("mesh: vertices " + std::to_string(a) + " and " +
                       std::to_string(b) +
                       " lie opposite a common edge and coincide: a bending spring "
                       "between them would have no length");
    }
    cloth_->springs.push_back({std::min(a, b), std::max(a, b)});
    volumes_.push_back(volume);
    return static_cast<int>(volumes_.size()) - 1;
  }

  void VisitEdge(int a, int b, int opposite, double area, double longest) {
    constexpr double kShorter = 1.0 - 1e-9;  // rounding of equal lengths
    Edge& edge = edges_[{std::min(a, b), std::max(a, b)}];
    if (edge.spring < 0) {
      edge.spring = Append(a, b, 0.0);
      edge.opposite = opposite;
    } else {
      Append(edge.opposite, opposite, 2.0 * area);
    }
    edge.volume += area;
    edge.is_longest &= Length(a, b) >= kShorter * longest;
  }

  const Eigen::VectorXd& positions_;
  ClothObject* cloth_;
  std::map<std::pair<int, int>, Edge> edges_;
  std::vector<double> volumes_;  // `vol` of each spring, m^2
};

}  // namespace

TriangleMesh MakeGrid(int rows, int cols, double size, GridPlane plane) {
  if (rows < 2 || cols < 2 || std::int64_t{rows} * cols > kMaxVertices) {
    throw SceneError("grid: " + std::to_string(rows) + " rows and " +
                     std::to_string(cols) +
                     " columns are not accepted; expected at least 2 of each and at "
                     "most " +
                     std::to_string(kMaxVertices) + " vertices");
  }
  if (!(size > 0.0) || !std::isfinite(size)) {
    throw SceneError("grid: size " + NumberText(size) +
                     " is not accepted; expected a finite number > 0 (m)");
  }
  TriangleMesh mesh;
  mesh.positions = Eigen::VectorXd::Zero(3 * rows * cols);
  const int axis_of_i = plane == GridPlane::kXZ ? 0 : 1;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < cols; ++i) {
      const int vertex = cols * j + i;
      mesh.positions[3 * vertex + axis_of_i] = size * (-0.5 + i / (cols - 1.0));
      mesh.positions[3 * vertex + 2] = size * (-0.5 + j / (rows - 1.0));
    }
  }
  for (int i = 0; i + 1 < cols; ++i) {
    for (int j = 0; j + 1 < rows; ++j) {
      const int a = cols * j + i, b = cols * (j + 1) + i, c = b + 1, d = a + 1;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

ClothObject BuildClothFromMesh(const TriangleMesh& mesh,
                               const ClothMaterial& material) {
  CheckMaterial(material);
  if (mesh.triangles.empty()) throw SceneError("mesh: it has no triangles");
  const int num_vertices = static_cast<int>(mesh.positions.size() / 3);
  ClothObject cloth;
  cloth.positions = mesh.positions;
  cloth.velocities = Eigen::VectorXd::Zero(3 * num_vertices);
  cloth.is_fixed.assign(num_vertices, 0);
  cloth.mass = Eigen::VectorXd::Zero(num_vertices);
  cloth.triangles = mesh.triangles;
  cloth.damping = material.damping;
  cloth.drag_coefficient = material.drag_coefficient;

  SpringBuilder springs(mesh, &cloth);
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    const double area = CheckedArea(mesh, t);
    springs.AddTriangle(mesh.triangles[t], area);
    for (int v : mesh.triangles[t]) cloth.mass[v] += material.density * area / 3.0;
  }
  springs.Finish(material);
  for (int v = 0; v < num_vertices; ++v) {
    if (cloth.mass[v] == 0.0) {
      throw SceneError("mesh: vertex " + std::to_string(v) +
                       " belongs to no triangle and would have no mass");
    }
  }
  return cloth;
}

}  // namespace dpe
