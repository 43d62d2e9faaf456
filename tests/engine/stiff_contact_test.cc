// Derivatives in hard contact. A collider of stiffness K adds h^2 K n n^T to the step
// matrix at the vertices that touch it, which may be 1e4 times their mass and more: the
// equations of those vertices are then so much larger than all others that a residual
// which is small beside them says nothing about the rest. What the Krylov method gives
// must be what the factorisation and differences give all the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/sensitivity.h"
#include "dpe/engine/simulator.h"
#include "support/derivative_checker.h"
#include "support/test_scenes.h"

namespace dpe::test {
namespace {

constexpr int kSide = 8;
constexpr int kFrames = 25;
constexpr double kTolerance = 1e-6;  // of the Krylov method
// Per step; errors of steps add up and are carried along.
constexpr double kErrorOverTolerance = 100.0;

// A loose cloth that falls on a large sphere at 2 m/s, beside its middle.
Scene ContactScene(IntegrationMethod method, double stiffness) {
  PresetOptions options;
  options.rows = options.cols = kSide;
  Scene scene = MakePresetScene(ScenePreset::kSide, options);
  scene.integration_method = method;
  scene.delta = 0.002;
  ClothObject& cloth = scene.objects[0];
  UnpinAll(&cloth);
  Perturb(3, &scene);
  for (int i = 0; i < cloth.num_vertices(); ++i) cloth.velocities[3 * i + 1] -= 2.0;
  scene.colliders = {SphereCollider({0.4, -7.03, 0.6}, 7.0)};
  scene.colliders[0].stiffness = stiffness;
  cloth.mass_mode = cloth.stiffness_mode = ParameterMode::kGlobal;
  cloth.estimate_initial_velocity = true;
  return scene;
}

// The deepest that any vertex is in the sphere, in any frame (m).
double Penetration(const Scene& scene, const Eigen::MatrixXd& positions) {
  const Collider& sphere = scene.colliders[0];
  double deepest = 0.0;
  for (int f = 0; f < positions.cols(); ++f) {
    for (int i = 0; i < positions.rows() / 3; ++i) {
      const Eigen::Vector3d x = positions.block<3, 1>(3 * i, f);
      deepest = std::max(deepest, 0.5 * sphere.scale[0] - (x - sphere.position).norm());
    }
  }
  return deepest;
}

struct ContactDerivatives {
  Eigen::VectorXd positions, tangent, gradient;
};

ContactDerivatives Compute(Scene scene, const std::string& solver) {
  scene.solver = solver;
  scene.tolerance = kTolerance;
  Simulator simulator(scene);
  const Eigen::VectorXd p = simulator.layout().Extract(scene);
  const Rollout rollout = simulator.Run(p, kFrames);
  EXPECT_TRUE(rollout.status().ok()) << rollout.status().Message();
  const Eigen::MatrixXd& x = rollout.trajectory().positions[0];
  EXPECT_GT(Penetration(scene, x), 0.0);
  Sensitivity sensitivity(&simulator, &rollout);
  std::vector<Eigen::MatrixXd> dx, dv;
  const int size = static_cast<int>(p.size());
  sensitivity.JacobianVectorProduct(p.cwiseProduct(RandomVector(size, 1)), &dx, &dv);
  const Eigen::VectorXd weights = RandomVector(static_cast<int>(x.size()), 2);
  ContactDerivatives result{
      x.reshaped(), dx[0].reshaped(),
      sensitivity.Gradient({weights.reshaped(x.rows(), x.cols())})};
  EXPECT_TRUE(sensitivity.ok());
  return result;
}

double RelativeDifference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return (a - b).norm() / b.norm();
}

using Case = std::tuple<IntegrationMethod, double>;

class StiffContactTest : public testing::TestWithParam<Case> {};

TEST_P(StiffContactTest, TheKrylovMethodDifferentiatesAsTheFactorisationDoes) {
  const auto [method, stiffness] = GetParam();
  const Scene scene = ContactScene(method, stiffness);
  const ContactDerivatives direct = Compute(scene, "cholesky");
  const ContactDerivatives krylov = Compute(scene, "cg");
  const double allowed = kErrorOverTolerance * kTolerance;
  EXPECT_LE(RelativeDifference(krylov.positions, direct.positions), allowed);
  EXPECT_LE(RelativeDifference(krylov.tangent, direct.tangent), allowed);
  EXPECT_LE(RelativeDifference(krylov.gradient, direct.gradient), allowed);
  // Otherwise the two would be one.
  EXPECT_GT(RelativeDifference(krylov.tangent, direct.tangent), 0.0);
}

TEST_P(StiffContactTest, BothSolversDifferentiateAsDifferencesDo) {
  const auto [method, stiffness] = GetParam();
  const Scene scene = ContactScene(method, stiffness);
  Simulator exact(scene);
  const Eigen::VectorXd p = exact.layout().Extract(scene);
  const Eigen::VectorXd d = p.cwiseProduct(RandomVector(static_cast<int>(p.size()), 1));
  const auto rollout = [&](const Eigen::VectorXd& q) -> Eigen::VectorXd {
    return exact.Run(q, kFrames).trajectory().positions[0].reshaped();
  };
  for (const char* solver : {"cholesky", "cg"}) {
    const DerivativeCheck check =
        CheckDirectionalDerivative(rollout, p, d, Compute(scene, solver).tangent);
    EXPECT_LE(check.relative_error, kErrorOverTolerance * kTolerance)
        << solver << ": " << check;
  }
}

std::string CaseName(const testing::TestParamInfo<Case>& info) {
  return IntegrationMethodName(std::get<0>(info.param)) + "_1e" +
         std::to_string(std::lround(std::log10(std::get<1>(info.param))));
}

INSTANTIATE_TEST_SUITE_P(
    Stiffnesses, StiffContactTest,
    testing::Combine(testing::Values(IntegrationMethod::kLinearlyImplicitEuler,
                                     IntegrationMethod::kImplicitEuler,
                                     IntegrationMethod::kTrBdf2),
                     testing::Values(1e3, 1e6, 1e9)),
    CaseName);

}  // namespace
}  // namespace dpe::test
