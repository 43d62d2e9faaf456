// Compressed springs: what a linearly implicit step makes of a cloth that buckles, and
// what to do about it (linearly_implicit_euler.h).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/simulator.h"

namespace dpe::test {
namespace {

// A vertex of mass m between two springs along x, whose far ends are pushed in by a
// tenth in the first frame. From then on it buckles: f_y = m s^2 y for small y, with
// m s^2 = 2 k (L0 - l) / l.
Scene PushedVertex(double stiffness, double mass) {
  ClothObject object;
  object.positions.resize(9);
  object.positions << -1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0;
  object.velocities = Eigen::VectorXd::Zero(9);
  object.is_fixed = {1, 0, 1};
  object.mass = Eigen::VectorXd::Constant(3, mass);
  object.springs = {{0, 1}, {1, 2}};
  object.stiffness = Eigen::VectorXd::Constant(2, stiffness);
  for (int vertex : {0, 2}) {
    PrescribedPath path;
    path.vertex = vertex;
    path.positions.resize(3, 2);
    path.positions.col(0) = object.positions.segment<3>(3 * vertex);
    path.positions.col(1) = 0.9 * path.positions.col(0);
    object.prescribed_paths.push_back(path);
  }
  Scene scene;
  scene.gravity.setZero();
  scene.objects.push_back(object);
  return scene;
}

class BucklingTest : public testing::TestWithParam<std::tuple<std::string, double>> {};

// Below h s = 1, next to it, where the matrix is nearly singular, and beyond, where it
// is indefinite: the step is the one that the equation says.
TEST_P(BucklingTest, StepMultipliesTheVelocityByOneOverOneMinusHS) {
  const auto& [solver, hs] = GetParam();
  constexpr double kMass = 0.1, kStiffness = 50.0, kVelocity = 1e-7;
  Scene scene = PushedVertex(kStiffness, kMass);
  scene.solver = solver;
  scene.tolerance = 1e-12;
  scene.delta = hs / std::sqrt(2.0 * kStiffness * (0.1 / 0.9) / kMass);
  scene.objects[0].velocities[4] = kVelocity;
  const Trajectory trajectory = Simulator(scene).Simulate(3);
  ASSERT_TRUE(trajectory.status.ok()) << trajectory.status.Message();
  // The first step is free flight, y1 = h v1. In the second, with a = (h s)^2,
  // (1 - a)(v2 - v1) = a (y1 / h + v1).
  EXPECT_NEAR(trajectory.velocities[0](4, 1), kVelocity, 1e-10 * kVelocity);
  const double a = hs * hs;
  const double expected = kVelocity * (1.0 + 2.0 * a / (1.0 - a));
  EXPECT_NEAR(trajectory.velocities[0](4, 2), expected, 1e-8 * std::abs(expected));
}

INSTANTIATE_TEST_SUITE_P(All, BucklingTest,
                         testing::Combine(testing::Values("cholesky", "cg"),
                                          testing::Values(0.3, 0.99, 1.01, 1.5)),
                         [](const auto& info) {
                           return std::get<0>(info.param) + "_" +
                                  std::to_string(static_cast<int>(
                                      std::lround(100.0 * std::get<1>(info.param))));
                         });

// Kinetic energy, that of the springs, and that of height, J.
double Energy(const Scene& scene, const Trajectory& trajectory, int frame) {
  const ClothObject& cloth = scene.objects[0];
  const auto x = trajectory.positions[0].col(frame);
  const auto v = trajectory.velocities[0].col(frame);
  double energy = 0.0;
  for (int i = 0; i < cloth.num_vertices(); ++i) {
    if (cloth.is_fixed[i]) continue;
    energy += cloth.mass[i] * (0.5 * v.segment<3>(3 * i).squaredNorm() -
                               scene.gravity.dot(x.segment<3>(3 * i)));
  }
  for (int s = 0; s < cloth.num_springs(); ++s) {
    const auto length = [&](const auto& p) {
      return (p.template segment<3>(3 * cloth.springs[s][0]) -
              p.template segment<3>(3 * cloth.springs[s][1]))
          .norm();
    };
    const double stretch = length(x) - length(cloth.positions);
    energy += 0.5 * cloth.stiffness[s] * stretch * stretch;
  }
  return energy;
}

double LargestRiseOfEnergy(IntegrationMethod method, int steps_per_frame) {
  PresetOptions options;
  options.rows = options.cols = 24;
  Scene scene = MakePresetScene(ScenePreset::kSide, options);
  scene.integration_method = method;
  scene.delta = 0.16;
  scene.steps_per_frame = steps_per_frame;
  SimulatorOptions simulator_options;
  simulator_options.newton_tolerance = 1e-11;
  const Trajectory trajectory = Simulator(scene, simulator_options).Simulate(12);
  EXPECT_TRUE(trajectory.status.ok()) << trajectory.status.Message();
  double rise = -1e300;
  for (int f = 1; f < 12; ++f) {
    rise =
        std::max(rise, Energy(scene, trajectory, f) - Energy(scene, trajectory, f - 1));
  }
  return rise;
}

// Gravity does no net work and everything else takes energy away: a rise is an error of
// the steps.
TEST(CompressionTest, ShorterStepsOrImplicitEulerLoseEnergyAsTheyShould) {
  EXPECT_GT(LargestRiseOfEnergy(IntegrationMethod::kLinearlyImplicitEuler, 1), 0.1);
  EXPECT_LT(LargestRiseOfEnergy(IntegrationMethod::kLinearlyImplicitEuler, 4), 0.0);
  EXPECT_LT(LargestRiseOfEnergy(IntegrationMethod::kImplicitEuler, 1), 0.0);
}

TEST(CompressionTest, MessageSaysWhatToDo) {
  Scene scene = PushedVertex(50.0, 0.1);
  scene.objects[0].velocities[4] = 1e14;
  const Trajectory trajectory = Simulator(scene).Simulate(3);
  EXPECT_EQ(trajectory.status.code, RolloutStatus::Code::kNotFinite);
  EXPECT_NE(trajectory.status.Message().find("forwardSubSteps"), std::string::npos);
}

}  // namespace
}  // namespace dpe::test
