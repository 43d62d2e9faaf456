// Physical identities of rollouts, and the order of accuracy of each integrator.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/sensitivity.h"
#include "dpe/engine/simulator.h"
#include "support/integration_methods.h"
#include "support/test_scenes.h"

namespace dpe::test {
namespace {

class RolloutTest : public testing::TestWithParam<IntegrationMethod> {};

Trajectory MustSimulate(const Scene& scene, int num_frames) {
  const Trajectory trajectory = Simulator(scene).Simulate(num_frames);
  EXPECT_TRUE(trajectory.status.ok()) << trajectory.status.Message();
  return trajectory;
}

// A smooth motion: a small cloth swings from one edge.
Scene SmoothScene(IntegrationMethod method) {
  PresetOptions options;
  options.rows = options.cols = 4;
  options.size = 2.0;
  Scene scene = MakePresetScene(ScenePreset::kSide, options);
  scene.integration_method = method;
  scene.wind = {1.0, 0.0, 0.5};
  return scene;
}

TEST_P(RolloutTest, OrderOfAccuracyWhenDeltaIsHalved) {
  // The reference is at delta / 64 of the coarser step; what is left of its own error
  // is taken out by Richardson extrapolation with delta / 32.
  const bool second_order = GetParam() == IntegrationMethod::kTrBdf2;
  const double order = second_order ? 2.0 : 1.0;
  Scene scene = SmoothScene(GetParam());
  const double end = 0.2;
  const double delta = 0.004;
  const auto final_state = [&](double step) {
    scene.delta = step;
    return MustSimulate(scene, static_cast<int>(std::lround(end / step)) + 1)
        .positions[0]
        .rightCols<1>()
        .eval();
  };
  const Eigen::VectorXd fine = final_state(delta / 64);
  const Eigen::VectorXd reference =
      fine + (fine - final_state(delta / 32)) / (std::exp2(order) - 1.0);
  const double coarse_error = (final_state(delta) - reference).norm();
  const double half_error = (final_state(delta / 2) - reference).norm();
  const double quarter_error = (final_state(delta / 4) - reference).norm();
  EXPECT_NEAR(std::log2(coarse_error / half_error), order, second_order ? 0.15 : 0.1);
  EXPECT_NEAR(std::log2(half_error / quarter_error), order, second_order ? 0.15 : 0.1);
  EXPECT_GT(quarter_error, 1e-9);
}

TEST_P(RolloutTest, ScalingMassAndStiffnessLeavesTheMotionUnchanged) {
  Scene scene = MakeDerivativeScene("side", 5);
  scene.integration_method = GetParam();
  scene.delta = 0.004;
  Perturb(1, &scene);
  scene.objects[0].drag_coefficient = 0.0;
  const Trajectory first = MustSimulate(scene, 40);
  scene.objects[0].mass *= 8.0;
  scene.objects[0].stiffness *= 8.0;
  const Trajectory second = MustSimulate(scene, 40);
  EXPECT_LT((first.positions[0] - second.positions[0]).cwiseAbs().maxCoeff(), 1e-10);
  // Only the ratio is free: mass alone does change the motion.
  scene.objects[0].mass *= 2.0;
  const Trajectory third = MustSimulate(scene, 40);
  EXPECT_GT((first.positions[0] - third.positions[0]).cwiseAbs().maxCoeff(), 1e-3);
}

TEST_P(RolloutTest, FreeClothConservesMomentum) {
  Scene scene = MakeDerivativeScene("side", 5);
  scene.integration_method = GetParam();
  scene.delta = 0.004;
  Perturb(2, &scene);
  ClothObject& cloth = scene.objects[0];
  std::fill(cloth.is_fixed.begin(), cloth.is_fixed.end(), 0);
  cloth.drag_coefficient = 0.0;
  cloth.damping = 0.0;
  scene.gravity.setZero();
  const Trajectory trajectory = MustSimulate(scene, 40);
  const auto momentum = [&](int frame) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int i = 0; i < cloth.num_vertices(); ++i) {
      sum += cloth.mass[i] * trajectory.velocities[0].col(frame).segment<3>(3 * i);
    }
    return sum;
  };
  const double scale =
      cloth.mass.sum() * trajectory.velocities[0].cwiseAbs().maxCoeff();
  EXPECT_LT((momentum(39) - momentum(0)).norm(), 1e-12 * scale);
  EXPECT_GT((trajectory.velocities[0].col(39) - trajectory.velocities[0].col(0)).norm(),
            0.1);
}

// One step of the scalar equation y'' = -9.81 - alpha y' by each method, by hand.
void StepByHand(IntegrationMethod method, double h, double alpha, double* y,
                double* v) {
  const double y0 = *y, v0 = *v, g = -9.81;
  if (method == IntegrationMethod::kTrBdf2) {
    const double c = (1.0 - std::sqrt(0.5)) * h, w = 0.5 * (1.0 + std::sqrt(2.0));
    const double vs = (v0 + c * (g - alpha * v0) + c * g) / (1.0 + alpha * c);
    const double ys = y0 + c * (v0 + vs);
    *v = (w * vs - (w - 1.0) * v0 + c * g) / (1.0 + alpha * c);
    *y = w * ys - (w - 1.0) * y0 + c * *v;
    return;
  }
  const bool implicit = method == IntegrationMethod::kLinearlyImplicitEuler ||
                        method == IntegrationMethod::kImplicitEuler;
  *v = implicit ? (v0 + h * g) / (1.0 + alpha * h) : v0 + h * (g - alpha * v0);
  *y += h * (method == IntegrationMethod::kExplicitEuler ? v0 : *v);
}

TEST_P(RolloutTest, FallingClothFollowsTheScalarRecursion) {
  // A cloth that falls freely does not deform.
  Scene scene = MakeDerivativeScene("side", 3);
  scene.integration_method = GetParam();
  ClothObject& cloth = scene.objects[0];
  std::fill(cloth.is_fixed.begin(), cloth.is_fixed.end(), 0);
  cloth.drag_coefficient = 0.0;
  cloth.damping = 0.5;
  const Trajectory trajectory = MustSimulate(scene, 50);
  double y = 0.0, v = 0.0;
  for (int frame = 1; frame < 50; ++frame) {
    StepByHand(GetParam(), scene.delta, cloth.damping, &y, &v);
    for (int i = 0; i < cloth.num_vertices(); ++i) {
      ASSERT_NEAR(trajectory.positions[0](3 * i + 1, frame), y, 1e-11);
      ASSERT_NEAR(trajectory.velocities[0](3 * i + 1, frame), v, 1e-11);
    }
  }
}

TEST_P(RolloutTest, PrescribedPathIsFollowedAndDrivesTheCloth) {
  Scene scene = MakeDerivativeScene("two_objects", 5);
  scene.integration_method = GetParam();
  scene.delta = 0.004;
  scene.steps_per_frame = 4;
  const Trajectory trajectory = MustSimulate(scene, 8);
  const PrescribedPath& path = scene.objects[1].prescribed_paths[0];
  for (int frame = 0; frame < 8; ++frame) {
    const Eigen::Vector3d expected = path.positions.col(std::min(frame, 3));
    EXPECT_EQ(trajectory.positions[1].col(frame).head<3>(), expected);
  }
  EXPECT_NEAR(trajectory.velocities[1](1, 2), 0.002 / scene.delta, 1e-9);
  EXPECT_EQ(trajectory.velocities[1](1, 7), 0.0);
  scene.objects[1].prescribed_paths.clear();
  const Trajectory still = MustSimulate(scene, 8);
  EXPECT_GT(
      (trajectory.positions[1].col(7) - still.positions[1].col(7)).tail(3 * 4).norm(),
      1e-9);
}

INSTANTIATE_TEST_SUITE_P(All, RolloutTest, AllIntegrationMethods(), MethodCaseName);

TEST(RolloutStatusTest, BlowUpIsAStatusThatNamesThePlace) {
  Scene scene = MakeDerivativeScene("side", 6);
  scene.integration_method = IntegrationMethod::kExplicitEuler;
  scene.objects[0].stiffness *= 1e6;
  const Trajectory trajectory = Simulator(scene).Simulate(200);
  EXPECT_EQ(trajectory.status.code, RolloutStatus::Code::kNotFinite);
  EXPECT_EQ(trajectory.status.object, 0);
  ASSERT_GT(trajectory.status.frame, 0);
  EXPECT_TRUE(trajectory.positions[0].col(trajectory.status.frame - 1).allFinite());
  EXPECT_TRUE(trajectory.positions[0].col(trajectory.status.frame).hasNaN());
  EXPECT_NE(trajectory.status.Message().find("frame"), std::string::npos);
}

TEST(RolloutStatusTest, NewtonConvergesOnLargerClothsToo) {
  // Rounding leaves more of the residual there than newton_tolerance asks for.
  for (const IntegrationMethod method :
       {IntegrationMethod::kImplicitEuler, IntegrationMethod::kTrBdf2}) {
    Scene scene = MakeDerivativeScene("side", 32);
    scene.integration_method = method;
    MustSimulate(scene, 8);
  }
}

TEST(RolloutStatusTest, InterruptionStopsWithinAStep) {
  const Scene scene = MakeDerivativeScene("side", 6);
  SimulatorOptions options;
  int polls = 0;
  options.interrupted = [&] { return ++polls > 10; };
  const Trajectory trajectory = Simulator(scene, options).Simulate(100);
  EXPECT_EQ(trajectory.status.code, RolloutStatus::Code::kInterrupted);
  EXPECT_EQ(trajectory.status.frame, 11);
}

TEST(RolloutStatusTest, ThreadsDoNotChangeTheResult) {
  const Scene scene = MakeDerivativeScene("two_objects", 8);
  SimulatorOptions options;
  options.num_threads = 2;
  const Trajectory parallel = Simulator(scene, options).Simulate(20);
  const Trajectory serial = Simulator(scene).Simulate(20);
  EXPECT_EQ(parallel.positions[0], serial.positions[0]);
  EXPECT_EQ(parallel.positions[1], serial.positions[1]);
}

TEST(RolloutStatusTest, TimesAddUpAndCountCalls) {
  const Scene scene = MakeDerivativeScene("side", 8);
  Timings timings;
  SimulatorOptions options;
  options.timings = &timings;
  const auto start = std::chrono::steady_clock::now();
  Simulator simulator(scene, options);
  const Rollout rollout = simulator.Run(simulator.layout().Extract(scene), 11);
  EXPECT_EQ(timings.Calls(TimedPart::kFactorization), 10);
  EXPECT_EQ(timings.Calls(TimedPart::kSolve), 10);
  EXPECT_EQ(timings.Calls(TimedPart::kDerivatives), 0);
  Sensitivity(&simulator, &rollout).Gradient(rollout.trajectory().positions);
  const std::chrono::duration<double> elapsed =
      std::chrono::steady_clock::now() - start;
  EXPECT_EQ(timings.Calls(TimedPart::kDerivatives), 1);
  // What the pass solves counts as the pass alone.
  EXPECT_EQ(timings.Calls(TimedPart::kSolve), 10);
  double sum = 0.0;
  for (const TimedPart part :
       {TimedPart::kForces, TimedPart::kAssembly, TimedPart::kFactorization,
        TimedPart::kSolve, TimedPart::kDerivatives}) {
    EXPECT_GT(timings.Seconds(part), 0.0);
    sum += timings.Seconds(part);
  }
  EXPECT_LT(sum, elapsed.count());
}

TEST(RolloutStatusTest, ObjectsWithoutEstimatedParametersAreLeftOut) {
  Scene scene = MakeDerivativeScene("two_objects", 5);
  ApplySettings("nL", &scene);
  SimulatorOptions options;
  options.only_estimated_objects = true;
  Simulator simulator(scene, options);
  EXPECT_TRUE(simulator.is_simulated(0));
  EXPECT_FALSE(simulator.is_simulated(1));
  const Trajectory trajectory = simulator.Simulate(5);
  EXPECT_EQ(trajectory.positions[1].size(), 0);
  EXPECT_EQ(trajectory.num_frames(), 5);
}

}  // namespace
}  // namespace dpe::test
