#include "dpe/estimation/motion_sensitivity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <cmath>

#include "dpe/engine/sensitivity.h"
#include "support/test_scenes.h"

namespace dpe::test {
namespace {

using ::testing::HasSubstr;

// A single free vertex on a spring above a fixed one, without gravity: an oscillator,
// or, if it is compressed and pushed aside, an upright pendulum that falls over.
Scene OneVertex(double stiffness, double rest_length) {
  Scene scene;
  scene.gravity.setZero();
  scene.integration_method = IntegrationMethod::kTrBdf2;
  scene.delta = 0.01;
  ClothObject cloth;
  cloth.positions.resize(6);
  cloth.positions << 0, 0, 0, 0, 1, 0;
  cloth.velocities.setZero(6);
  cloth.is_fixed = {1, 0};
  cloth.mass.setConstant(2, 1.0);
  cloth.springs = {{0, 1}};
  cloth.stiffness.setConstant(1, stiffness);
  cloth.rest_length.setConstant(1, rest_length);
  scene.objects = {cloth};
  return scene;
}

// The same between two springs of the given rest length, fixed 1 m above and below.
Scene BetweenTwoSprings(double rest_length) {
  Scene scene = OneVertex(100.0, rest_length);
  ClothObject& cloth = scene.objects[0];
  cloth.positions.conservativeResize(9);
  cloth.positions.tail<3>() << 0, 2, 0;
  cloth.velocities.setZero(9);
  cloth.is_fixed = {1, 0, 1};
  cloth.mass.setConstant(3, 1.0);
  cloth.springs = {{0, 1}, {1, 2}};
  cloth.stiffness.setConstant(2, 100.0);
  cloth.rest_length.setConstant(2, rest_length);
  return scene;
}

// Compressed by c, a spring pushes sideways with k c / l per unit of displacement: e^(s
// t) with s^2 = k c / (m l).
TEST(MotionSensitivityTest, AnUnstableEquilibriumGrowsExponentially) {
  const Scene scene = OneVertex(0.0, 1.0);
  // Free flight: z = (x, h v) becomes x + (F - 1) h v.
  const MotionSensitivity free = ComputeMotionSensitivity(scene, 101);
  ASSERT_TRUE(free.ok) << free.message;
  EXPECT_NEAR(free.growth, std::hypot(1.0, 100.0), 1e-6);
  const Scene pressed = BetweenTwoSprings(1.25);
  const double rate = std::sqrt(2.0 * 100.0 * 0.25);
  const MotionSensitivity falling = ComputeMotionSensitivity(pressed, 101);
  ASSERT_TRUE(falling.ok) << falling.message;
  // x = cosh(s t) x0 + sinh(s t) / s v0, t = 1 s.
  const double expected =
      std::hypot(std::cosh(rate), std::sinh(rate) / rate / pressed.delta);
  EXPECT_NEAR(falling.growth / expected, 1.0, 0.02);
  EXPECT_NEAR(falling.doubling_time, 1.0 / std::log2(falling.growth), 1e-12);
  EXPECT_THAT(falling.text, HasSubstr("let the horizon grow"));
}

TEST(MotionSensitivityTest, DampedMotionForgets) {
  Scene scene = BetweenTwoSprings(0.75);  // stretched: held in all directions
  scene.objects[0].damping = 4.0;
  const MotionSensitivity result = ComputeMotionSensitivity(scene, 1001);
  ASSERT_TRUE(result.ok) << result.message;
  EXPECT_LT(result.growth, 0.1);
  EXPECT_TRUE(std::isinf(result.doubling_time));
  EXPECT_THAT(result.text, HasSubstr("faded"));
}

// Against the singular values of the whole matrix.
TEST(MotionSensitivityTest, IsTheLargestSingularValue) {
  Scene scene = MakeDerivativeScene("flag", 4);
  constexpr int kFrames = 12;
  const MotionSensitivity result = ComputeMotionSensitivity(scene, kFrames);
  ASSERT_TRUE(result.ok) << result.message;
  ClothObject& cloth = scene.objects[0];
  cloth.mass_mode = cloth.stiffness_mode = ParameterMode::kFixed;
  cloth.estimate_damping = cloth.estimate_drag = scene.estimate_wind = false;
  cloth.rest_length = RestLengths(cloth);
  cloth.estimate_initial_position = cloth.estimate_initial_velocity = true;
  Simulator simulator(scene);
  const Rollout rollout = simulator.Run(simulator.layout().Extract(scene), kFrames);
  Sensitivity sensitivity(&simulator, &rollout);
  Eigen::MatrixXd tangent(3 * cloth.num_vertices(), simulator.layout().size());
  for (const ParameterBlock& block : simulator.layout().blocks()) {
    const bool is_velocity = block.kind == ParameterKind::kInitialVelocity;
    for (int j = block.offset; j < block.offset + block.size; ++j) {
      std::vector<Eigen::MatrixXd> dx, dv;
      sensitivity.JacobianVectorProduct(
          Eigen::VectorXd::Unit(tangent.cols(), j) / (is_velocity ? scene.delta : 1.0),
          &dx, &dv);
      tangent.col(j) = dx[0].col(kFrames - 1);
    }
  }
  const double largest = Eigen::JacobiSVD<Eigen::MatrixXd>(tangent).singularValues()[0];
  EXPECT_LE(result.growth, largest * (1.0 + 1e-10));
  EXPECT_GT(result.growth, 0.95 * largest);
  EXPECT_EQ(result.growth_by_frame.size(), kFrames);
  EXPECT_DOUBLE_EQ(result.growth_by_frame[kFrames - 1], result.growth);
}

TEST(MotionSensitivityTest, WhatCannotBeSimulatedSaysWhy) {
  Scene scene = OneVertex(1e9, 0.9);
  scene.integration_method = IntegrationMethod::kExplicitEuler;
  const MotionSensitivity result = ComputeMotionSensitivity(scene, 300);
  EXPECT_FALSE(result.ok);
  EXPECT_THAT(result.message, HasSubstr("finite"));
  SimulatorOptions options;
  options.interrupted = [] { return true; };
  EXPECT_FALSE(ComputeMotionSensitivity(OneVertex(1.0, 1.0), 50, options).ok);
}

}  // namespace
}  // namespace dpe::test
