// The predicted limits of explicit steps: known ones of one spring, and what rollouts
// just below and above them do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dpe/engine/simulator.h"
#include "experiments/stability/energy_history.h"
#include "experiments/stability/step_limit.h"

namespace dpe::experiments {
namespace {

constexpr double kStiffness = 300.0;  // N/m
constexpr double kMass = 0.2;         // kg

// One vertex on a spring that swings along its axis.
Scene Spring(IntegrationMethod method, double damping) {
  Scene scene;
  scene.integration_method = method;
  scene.gravity.setZero();
  ClothObject object;
  object.positions.resize(6);
  object.positions << 0.0, 0.0, 0.0, 1.0, 0.0, 0.0;
  object.velocities.setZero(6);
  object.velocities[3] = 0.01;
  object.is_fixed = {1, 0};
  object.mass.setConstant(2, kMass);
  object.springs = {{0, 1}};
  object.stiffness = Eigen::VectorXd::Constant(1, kStiffness);
  object.damping = damping;
  scene.objects.push_back(object);
  return scene;
}

StepLimit Predict(const Scene& scene) {
  return PredictStepLimit(scene, scene.objects[0].positions,
                          scene.objects[0].velocities);
}

// How many times its first size the swing has after so many steps of length h, as seen
// in the last 50 of them: half a period of the slowest swing here.
double Growth(Scene scene, double h, int steps) {
  scene.delta = h;
  const Trajectory trajectory = Simulator(scene).Simulate(steps + 1);
  if (!trajectory.status.ok()) return 1e12;
  return trajectory.velocities[0].rightCols<50>().row(3).cwiseAbs().maxCoeff() / 0.01;
}

class StepLimitTest : public testing::TestWithParam<double> {};  // damping

TEST_P(StepLimitTest, IsTheFormulaAndWhatRolloutsShow) {
  const double damping = GetParam();
  const double w2 = kStiffness / kMass;
  const double c = damping + 0.5 * damping * w2;
  const double symplectic = 4.0 / (c + std::sqrt(c * c + 4.0 * w2));
  double explicit_euler = c / w2;
  if (c * c > 4.0 * w2) {
    explicit_euler = std::min(explicit_euler, 4.0 / (c + std::sqrt(c * c - 4.0 * w2)));
  }
  for (auto method :
       {IntegrationMethod::kExplicitEuler, IntegrationMethod::kSymplecticEuler}) {
    const Scene scene = Spring(method, damping);
    const StepLimit limit = Predict(scene);
    EXPECT_NEAR(limit.omega_max, std::sqrt(w2), 1e-3 * std::sqrt(w2));
    const double expected =
        method == IntegrationMethod::kExplicitEuler ? explicit_euler : symplectic;
    EXPECT_NEAR(limit.limit, expected, 2e-3 * expected + 1e-8);
    if (expected == 0.0) continue;
    // Explicit Euler's modes grow in proportion to h c, which may be small.
    const int steps = 2000 + static_cast<int>(300.0 / (expected * std::max(c, 1.0)));
    EXPECT_LT(Growth(scene, 0.95 * expected, steps), 5.0);
    EXPECT_GT(Growth(scene, 1.05 * expected, steps), 30.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Dampings, StepLimitTest,
                         testing::Values(0.0, 0.005, 0.05, 0.5));

TEST(StepGrowthTest, WithoutDampingExplicitEulerGrowsAsPredicted) {
  Scene scene = Spring(IntegrationMethod::kExplicitEuler, 0.0);
  scene.delta = 0.002;
  const StepLimit limit = Predict(scene);
  const double h2w2 = scene.delta * scene.delta * kStiffness / kMass;
  EXPECT_NEAR(limit.factor, std::sqrt(1.0 + h2w2), 1e-6);
  // The last peak is up to half a period, 41 steps, before the end.
  EXPECT_NEAR(std::log(Growth(scene, scene.delta, 1000)),
              1000.0 * std::log(limit.factor), 45.0 * std::log(limit.factor));
}

TEST(EnergyHistoryTest, EachMethodKeepsOrLosesWhatItMust) {
  const auto end = [](IntegrationMethod method) {
    return EnergyHistory(method).Number("energy_end", 0.0);
  };
  for (auto method :
       {IntegrationMethod::kSymplecticEuler, IntegrationMethod::kTrBdf2}) {
    const Record row = EnergyHistory(method);
    EXPECT_EQ(row.Text("result", ""), "ok");
    EXPECT_LT(row.Number("momentum_drift", 1.0), 1e-10);
    EXPECT_EQ(ParseSamples(row.Text("energy", "")).size(),
              ParseSamples(row.Text("time", "")).size());
  }
  // Symplectic Euler swings about the true energy, and conserves angular momentum, as
  // its forces are central and act at the positions that turn them.
  EXPECT_NEAR(end(IntegrationMethod::kSymplecticEuler), 1.0, 0.05);
  EXPECT_LT(
      EnergyHistory(IntegrationMethod::kSymplecticEuler).Number("angular_drift", 1.0),
      1e-10);
  // Most of the energy is that of the cloth as a whole, which no method damps.
  EXPECT_LT(end(IntegrationMethod::kImplicitEuler), 0.995);
  EXPECT_LT(end(IntegrationMethod::kLinearlyImplicitEuler), 0.995);
  EXPECT_GT(end(IntegrationMethod::kTrBdf2), end(IntegrationMethod::kImplicitEuler));
  EXPECT_GT(end(IntegrationMethod::kExplicitEuler), 1.05);
}

}  // namespace
}  // namespace dpe::experiments
