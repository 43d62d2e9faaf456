#include "support/scene_derivatives.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "support/derivative_checker.h"

namespace dpe::test {
namespace {

double RelativeDistance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  if (a == b) return 0.0;
  return (a - b).norm() / b.norm();
}

double RelativeDistance(const std::vector<Eigen::MatrixXd>& a,
                        const std::vector<Eigen::MatrixXd>& b) {
  double distance = 0.0;
  for (size_t o = 0; o < a.size(); ++o) {
    distance = std::max(distance, RelativeDistance(a[o], b[o]));
  }
  return distance;
}

std::vector<Eigen::MatrixXd> RandomLike(const std::vector<Eigen::MatrixXd>& like,
                                        unsigned seed) {
  std::vector<Eigen::MatrixXd> result = like;
  for (Eigen::MatrixXd& m : result) {
    m.reshaped() = RandomVector(static_cast<int>(m.size()), seed++);
  }
  return result;
}

}  // namespace

std::vector<StateDerivative> RandomRows(const Scene& scene, int num_frames,
                                        int* num_rows) {
  std::mt19937 generator(3);
  std::vector<StateDerivative> derivatives;
  *num_rows = 150;  // more than one block of adjoint rows
  for (int k = 0; k < 60; ++k) {
    StateDerivative d;
    d.object = k % static_cast<int>(scene.objects.size());
    d.frame = static_cast<int>(generator() % num_frames);
    d.first_row = static_cast<int>(generator() % (*num_rows - 3));
    const int n = 3 * scene.objects[d.object].num_vertices();
    d.d_position.resize(3, n);
    d.d_velocity.resize(3, n);
    for (int r = 0; r < 3; ++r) {
      d.d_position.insert(r, generator() % n) = 1.0 + r;
      if (k % 2 == 0) d.d_velocity.insert(r, generator() % n) = 0.1;
    }
    if (k % 2 != 0) d.d_velocity.resize(0, 0);
    derivatives.push_back(d);
  }
  return derivatives;
}

SceneDerivatives ComputeDerivatives(const Scene& scene, const SimulatorOptions& options,
                                    int num_frames) {
  SceneDerivatives result;
  Simulator simulator(scene, options);
  const Eigen::VectorXd p = simulator.layout().Extract(scene);
  const Rollout rollout = simulator.Run(p, num_frames);
  EXPECT_TRUE(rollout.status().ok()) << rollout.status().Message();
  result.positions = rollout.trajectory().positions;
  result.velocities = rollout.trajectory().velocities;
  result.kept_bytes = rollout.kept_bytes();
  Sensitivity sensitivity(&simulator, &rollout);
  result.gradient = sensitivity.Gradient(RandomLike(result.positions, 5),
                                         RandomLike(result.velocities, 15));
  const Eigen::VectorXd direction =
      RandomVector(static_cast<int>(p.size()), 21).cwiseProduct(p);
  sensitivity.JacobianVectorProduct(direction, &result.dx, &result.dv);
  int num_rows = 0;
  const auto rows = RandomRows(scene, num_frames, &num_rows);
  result.tangent = sensitivity.Jacobian(rows, num_rows, JacobianMethod::kTangent);
  result.adjoint = sensitivity.Jacobian(rows, num_rows, JacobianMethod::kAdjoint);
  EXPECT_TRUE(sensitivity.ok());
  EXPECT_GT(result.gradient.norm(), 0.0);
  EXPECT_GT(result.tangent.norm(), 0.0);
  return result;
}

double Distance(const SceneDerivatives& a, const SceneDerivatives& b) {
  if (a.positions != b.positions || a.velocities != b.velocities) {
    return std::numeric_limits<double>::infinity();
  }
  return std::max({RelativeDistance(a.gradient, b.gradient),
                   RelativeDistance(a.dx, b.dx), RelativeDistance(a.dv, b.dv),
                   RelativeDistance(a.tangent, b.tangent),
                   RelativeDistance(a.adjoint, b.adjoint)});
}

}  // namespace dpe::test
