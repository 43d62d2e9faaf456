#include "dpe/estimation/inverse_dynamics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <ostream>
#include <string>

#include "support/test_scenes.h"

namespace dpe {
namespace {

constexpr int kFrames = 30;
constexpr char kDamping = 'd', kDrag = 'c', kWind = 'w', kVelocity = 'v';

struct Case {
  const char* scene;
  const char* settings;  // of every object
  const char* extra;     // letters of the constants above
  double tolerance;      // relative, of every value
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.scene << "_" << c.settings << c.extra;
}

Scene MakeScene(const Case& c, IntegrationMethod method) {
  Scene scene = test::MakeDerivativeScene(c.scene, 5);
  test::Perturb(1, &scene);
  scene.integration_method = method;
  if (method == IntegrationMethod::kExplicitEuler ||
      method == IntegrationMethod::kSymplecticEuler) {
    // The flag's wind at the presets' step is beyond what explicit methods can take.
    scene.delta = 0.004;
    scene.wind *= 0.1;
  }
  std::string settings;
  const std::string extra = c.extra;
  for (ClothObject& object : scene.objects) {
    settings += (settings.empty() ? "" : ",") + std::string(c.settings);
    object.estimate_damping = extra.find(kDamping) != std::string::npos;
    object.estimate_drag = extra.find(kDrag) != std::string::npos;
    object.estimate_initial_velocity = extra.find(kVelocity) != std::string::npos;
  }
  scene.estimate_wind = extra.find(kWind) != std::string::npos;
  ApplySettings(settings, &scene);
  // Modes G and R can only find what they can express.
  const ParameterLayout layout(scene);
  layout.Insert(layout.Extract(scene), &scene);
  return scene;
}

std::vector<double> FreeMassOf(const Scene& scene) {
  std::vector<double> sums;
  for (const ClothObject& object : scene.objects) {
    double sum = 0.0;
    for (int v = 0; v < object.num_vertices(); ++v) {
      if (!object.is_fixed[v]) sum += object.mass[v];
    }
    sums.push_back(sum);
  }
  return sums;
}

SimulatorOptions OnlyEstimated() {
  SimulatorOptions options;
  options.only_estimated_objects = true;
  return options;
}

// The scene with all that is estimated overwritten.
Scene Overwritten(const Scene& scene) {
  const ParameterLayout layout(scene);
  Scene other = scene;
  layout.Insert(Eigen::VectorXd::Constant(layout.size(), 0.7), &other);
  return other;
}

InverseDynamicsResult Solve(const Scene& scene, const Scene& known, int num_frames) {
  const Observations target =
      ObserveAll(Simulator(scene, OnlyEstimated()).Simulate(num_frames));
  Simulator simulator(known, OnlyEstimated());
  return SolveInverseDynamics(&simulator, target, num_frames, FreeMassOf(scene));
}

class InverseDynamicsTest
    : public ::testing::TestWithParam<std::tuple<Case, IntegrationMethod>> {};

TEST_P(InverseDynamicsTest, RecoversTheParametersExactly) {
  const auto [c, method] = GetParam();
  const Scene scene = MakeScene(c, method);
  const InverseDynamicsResult result = Solve(scene, Overwritten(scene), kFrames);
  ASSERT_TRUE(result.ok) << result.message;
  EXPECT_TRUE(result.undetermined.empty());
  const ParameterLayout layout(scene);
  const Eigen::VectorXd truth = layout.Extract(scene);
  for (const ParameterBlock& block : layout.blocks()) {
    const auto expected = truth.segment(block.offset, block.size);
    const auto found = result.parameters.segment(block.offset, block.size);
    EXPECT_LT((found - expected).cwiseAbs().maxCoeff(),
              c.tolerance * expected.cwiseAbs().minCoeff())
        << ParameterKindName(block.kind);
  }
}

INSTANTIATE_TEST_SUITE_P(
    AllMethods, InverseDynamicsTest,
    ::testing::Combine(
        ::testing::Values(Case{"side", "nL", "", 1e-8}, Case{"side", "Ln", "", 1e-8},
                          Case{"side", "LL", "", 1e-7}, Case{"flag", "LL", "", 1e-7},
                          Case{"flag", "GG", "", 1e-8}, Case{"flag", "RR", "", 1e-8},
                          Case{"corners", "RL", "", 1e-7},
                          Case{"collider", "LG", "", 1e-8},
                          Case{"two_objects", "nL", "", 1e-8},
                          Case{"flag", "nL", "d", 1e-7}, Case{"flag", "LL", "d", 1e-6},
                          Case{"flag", "nn", "d", 1e-8}, Case{"flag", "GG", "dc", 1e-6},
                          Case{"flag", "nR", "c", 1e-7}, Case{"flag", "nn", "w", 1e-8},
                          Case{"flag", "nL", "wc", 1e-6},
                          Case{"two_objects", "nL", "dw", 1e-5}),
        ::testing::Values(IntegrationMethod::kExplicitEuler,
                          IntegrationMethod::kSymplecticEuler,
                          IntegrationMethod::kLinearlyImplicitEuler,
                          IntegrationMethod::kImplicitEuler)));

// Everything at once; the explicit methods' short steps show too little for that.
INSTANTIATE_TEST_SUITE_P(
    ImplicitMethods, InverseDynamicsTest,
    ::testing::Combine(::testing::Values(Case{"two_objects", "LL", "dw", 1e-5}),
                       ::testing::Values(IntegrationMethod::kLinearlyImplicitEuler,
                                         IntegrationMethod::kImplicitEuler)));

TEST(InverseDynamicsGaugeTest, KeepsTheTotalMassWhereNoKnownForceFixesIt) {
  Scene scene =
      MakeScene({"corners", "LL", "", 0.0}, IntegrationMethod::kLinearlyImplicitEuler);
  scene.objects[0].drag_coefficient = 0.0;
  const InverseDynamicsResult result = Solve(scene, Overwritten(scene), kFrames);
  ASSERT_TRUE(result.ok);
  ASSERT_EQ(result.notes.size(), 1u);
  EXPECT_THAT(result.notes[0], ::testing::HasSubstr("total mass"));
  const Eigen::VectorXd truth = ParameterLayout(scene).Extract(scene);
  EXPECT_LT(((result.parameters - truth).array() / truth.array()).abs().maxCoeff(),
            1e-7);
}

TEST(InverseDynamicsGaugeTest, AnotherTotalScalesEverything) {
  Scene scene =
      MakeScene({"corners", "LL", "c", 0.0}, IntegrationMethod::kLinearlyImplicitEuler);
  const Observations target = ObserveAll(Simulator(scene).Simulate(kFrames));
  Simulator simulator(Overwritten(scene));
  const InverseDynamicsResult result =
      SolveInverseDynamics(&simulator, target, kFrames, {3.0 * FreeMassOf(scene)[0]});
  const Eigen::VectorXd truth = 3.0 * ParameterLayout(scene).Extract(scene);
  EXPECT_LT(((result.parameters - truth).array() / truth.array()).abs().maxCoeff(),
            1e-7);
}

TEST(InverseDynamicsStartTest, InitialVelocityIsExactForExplicitEulerAndCloseElse) {
  for (const auto& [method, tolerance] :
       {std::pair(IntegrationMethod::kExplicitEuler, 1e-9),
        std::pair(IntegrationMethod::kLinearlyImplicitEuler, 0.2)}) {
    const Scene scene = MakeScene({"side", "nL", "v", 0.0}, method);
    const InverseDynamicsResult result = Solve(scene, Overwritten(scene), kFrames);
    ASSERT_TRUE(result.ok);
    const ParameterLayout layout(scene);
    const Eigen::VectorXd truth = layout.Extract(scene);
    for (const ParameterBlock& block : layout.blocks()) {
      const double allowed =
          block.kind == ParameterKind::kInitialVelocity ? tolerance : 1e-7;
      const auto expected = truth.segment(block.offset, block.size);
      EXPECT_LT((result.parameters.segment(block.offset, block.size) - expected).norm(),
                allowed * expected.norm())
          << ParameterKindName(block.kind) << IntegrationMethodName(method);
    }
  }
}

TEST(InverseDynamicsStartTest, SeveralStepsPerFrameGiveAStartThatIsNear) {
  Scene scene =
      MakeScene({"side", "nG", "", 0.0}, IntegrationMethod::kLinearlyImplicitEuler);
  scene.steps_per_frame = 4;
  const InverseDynamicsResult result = Solve(scene, Overwritten(scene), kFrames);
  ASSERT_TRUE(result.ok);
  const double truth = ParameterLayout(scene).Extract(scene)[0];
  EXPECT_NEAR(result.parameters[0], truth, 0.5 * truth);
  EXPECT_GT(std::abs(result.parameters[0] - truth), 1e-6 * truth);
}

TEST(InverseDynamicsStartTest, ElementsThatNeverMoveTakeTheMedianAndAreNamed) {
  // Without gravity and wind nothing moves, so no spring is ever stretched.
  Scene scene =
      MakeScene({"side", "nL", "", 0.0}, IntegrationMethod::kLinearlyImplicitEuler);
  scene.gravity.setZero();
  scene.wind.setZero();
  scene.objects[0].velocities.setZero();
  const InverseDynamicsResult result = Solve(scene, Overwritten(scene), kFrames);
  ASSERT_TRUE(result.ok);
  EXPECT_EQ(result.undetermined.size(), ParameterLayout(scene).size());
  EXPECT_GT(result.parameters.minCoeff(), 0.0);
  EXPECT_FALSE(result.notes.empty());
}

TEST(InverseDynamicsStartTest, ValuesThatNoiseMakesNegativeAreClampedAndCounted) {
  const Scene scene =
      MakeScene({"side", "nL", "", 0.0}, IntegrationMethod::kLinearlyImplicitEuler);
  Observations target = ObserveAll(Simulator(scene).Simulate(kFrames));
  AddNoise(scene, 0.05, 1, &target);
  Simulator simulator(Overwritten(scene));
  const InverseDynamicsResult result =
      SolveInverseDynamics(&simulator, target, kFrames, FreeMassOf(scene));
  ASSERT_TRUE(result.ok);
  EXPECT_GT(result.parameters.minCoeff(), 0.0);
  ASSERT_EQ(result.notes.size(), 1u);
  EXPECT_THAT(result.notes[0], ::testing::HasSubstr("at or below zero"));
}

TEST(InverseDynamicsInputTest, NeedsAllFreeVerticesAndEnoughFrames) {
  const Scene scene =
      MakeScene({"side", "nL", "", 0.0}, IntegrationMethod::kExplicitEuler);
  Observations target = ObserveAll(Simulator(scene).Simulate(5));
  Simulator simulator(scene);
  EXPECT_FALSE(SolveInverseDynamics(&simulator, target, 2, {1.0}).ok);
  EXPECT_TRUE(SolveInverseDynamics(&simulator, target, 3, {1.0}).ok);
  EXPECT_TRUE(InverseDynamicsApplies(scene, target));
  target.positions[0](4, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(InverseDynamicsApplies(scene, target));
  EXPECT_THROW(SolveInverseDynamics(&simulator, target, 5, {1.0}), SceneError);
}

}  // namespace
}  // namespace dpe
