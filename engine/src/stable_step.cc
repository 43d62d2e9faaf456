#include "dpe/engine/stable_step.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace dpe {
namespace {

// Per vertex, the largest eigenvalue of the sum that bounds its row of K, N/m.
Eigen::VectorXd StiffnessBound(const Scene& scene, const ClothObject& cloth) {
  double contact = 0.0;
  for (const Collider& collider : scene.colliders) contact += collider.stiffness;
  std::vector<Eigen::Matrix3d> sums(cloth.num_vertices(),
                                    contact * Eigen::Matrix3d::Identity());
  for (int s = 0; s < cloth.num_springs(); ++s) {
    const auto [a, b] = cloth.springs[s];
    const Eigen::Vector3d u =
        (cloth.positions.segment<3>(3 * a) - cloth.positions.segment<3>(3 * b))
            .normalized();
    const bool both_free = cloth.is_fixed[a] == 0 && cloth.is_fixed[b] == 0;
    for (int vertex : {a, b}) {
      sums[vertex] += (both_free ? 2.0 : 1.0) * cloth.stiffness[s] * u * u.transpose();
    }
  }
  Eigen::VectorXd bound(cloth.num_vertices());
  for (int i = 0; i < cloth.num_vertices(); ++i) {
    bound[i] =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sums[i], Eigen::EigenvaluesOnly)
            .eigenvalues()[2];
  }
  return bound;
}

// Per vertex, what drag takes of its velocity, kg/s.
Eigen::VectorXd DragBound(const Scene& scene, const ClothObject& cloth) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(cloth.num_vertices());
  for (const auto& [a, b, c] : cloth.triangles) {
    const auto at = [&](int i) { return cloth.positions.segment<3>(3 * i); };
    const Eigen::Vector3d e1 = at(b) - at(a), e2 = at(c) - at(a);
    const double n = e1.cross(e2).norm();
    const double grows = scene.aerodynamics == AerodynamicsLaw::kAuthored ? n * n : 1.0;
    const double drag = std::abs(cloth.drag_coefficient) / 3.0 * (0.5 * n) * grows;
    for (int vertex : {a, b, c}) sum[vertex] += drag;
  }
  return sum;
}

// The positive root h of w2 h^2 + (2 beta w2 + 2 alpha) h = 4, in the form that loses
// no digits.
double LongestStep(double w2, double alpha, double beta) {
  const double half = beta * w2 + alpha;
  const double denominator = half + std::sqrt(half * half + 4.0 * w2);
  return denominator > 0.0 ? 4.0 / denominator
                           : std::numeric_limits<double>::infinity();
}

}  // namespace

double StableStep(const Scene& scene) {
  double longest = std::numeric_limits<double>::infinity();
  for (const ClothObject& cloth : scene.objects) {
    const Eigen::VectorXd stiffness = StiffnessBound(scene, cloth);
    const Eigen::VectorXd drag = DragBound(scene, cloth);
    for (int i = 0; i < cloth.num_vertices(); ++i) {
      if (cloth.is_fixed[i] != 0) continue;
      longest = std::min(longest, LongestStep(stiffness[i] / cloth.mass[i],
                                              cloth.damping + drag[i] / cloth.mass[i],
                                              cloth.damping / 2.0));
    }
  }
  return longest;
}

}  // namespace dpe
