#include "captures/nearest_triangle.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>

namespace dpe {
namespace {

Eigen::Vector3d Vertex(const ClothObject& object, int v) {
  return object.positions.segment<3>(3 * v);
}

}  // namespace

// With d_k = ((b-a)·(p-k), (c-a)·(p-k)) for each corner k, the signs of d and of the
// 2x2 determinants va, vb, vc of pairs of them (p's barycentric coordinates in the
// plane, times the squared normal) say in which of the seven Voronoi regions of the
// triangle p lies: three corners, three edges, the inside.
Eigen::Vector3d NearestInTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                  const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a, ac = c - a;
  const Eigen::Vector3d ap = p - a, bp = p - b, cp = p - c;
  const double a1 = ab.dot(ap), a2 = ac.dot(ap);
  if (a1 <= 0.0 && a2 <= 0.0) return {1.0, 0.0, 0.0};
  const double b1 = ab.dot(bp), b2 = ac.dot(bp);
  if (b1 >= 0.0 && b2 <= b1) return {0.0, 1.0, 0.0};
  const double c1 = ab.dot(cp), c2 = ac.dot(cp);
  if (c2 >= 0.0 && c1 <= c2) return {0.0, 0.0, 1.0};

  const double vc = a1 * b2 - b1 * a2;
  if (vc <= 0.0 && a1 >= 0.0 && b1 <= 0.0) {
    const double t = a1 / (a1 - b1);
    return {1.0 - t, t, 0.0};
  }
  const double vb = c1 * a2 - a1 * c2;
  if (vb <= 0.0 && a2 >= 0.0 && c2 <= 0.0) {
    const double t = a2 / (a2 - c2);
    return {1.0 - t, 0.0, t};
  }
  const double va = b1 * c2 - c1 * b2;
  const double to_c = b2 - b1, to_b = c1 - c2;  // both >= 0 along the edge (b, c)
  if (va <= 0.0 && to_c >= 0.0 && to_b >= 0.0) {
    const double t = to_c / (to_c + to_b);
    return {0.0, 1.0 - t, t};
  }
  const double v = vb / (va + vb + vc), w = vc / (va + vb + vc);
  return {1.0 - v - w, v, w};
}

NearestPoint FindNearestTriangle(const Eigen::Vector3d& p, const ClothObject& object) {
  NearestPoint nearest;
  nearest.distance = std::numeric_limits<double>::infinity();
  for (size_t t = 0; t < object.triangles.size(); ++t) {
    const auto [i, j, k] = object.triangles[t];
    const Eigen::Vector3d a = Vertex(object, i), b = Vertex(object, j),
                          c = Vertex(object, k);
    const Eigen::Vector3d w = NearestInTriangle(p, a, b, c);
    const double distance = (w[0] * a + w[1] * b + w[2] * c - p).norm();
    if (distance >= nearest.distance) continue;
    nearest = {static_cast<int>(t), w, distance};
  }
  return nearest;
}

double MeanEdgeLength(const ClothObject& object) {
  double sum = 0.0;
  for (const auto& [i, j, k] : object.triangles) {
    const Eigen::Vector3d a = Vertex(object, i), b = Vertex(object, j),
                          c = Vertex(object, k);
    sum += (a - b).norm() + (b - c).norm() + (c - a).norm();
  }
  return object.triangles.empty()
             ? 0.0
             : sum / (3.0 * static_cast<double>(object.triangles.size()));
}

}  // namespace dpe
