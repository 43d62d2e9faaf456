// Steps that Newton's method alone does not solve.
#include <gtest/gtest.h>

#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/simulator.h"

namespace dpe::test {
namespace {

Scene SmallScene(ScenePreset preset, IntegrationMethod method, double delta) {
  PresetOptions options;
  options.rows = options.cols = 6;
  Scene scene = MakePresetScene(preset, options);
  scene.integration_method = method;
  scene.delta = delta;
  return scene;
}

// Wind of 150 m/s takes a cloth along by many times its size within a step of 0.5 s;
// from the velocity at rest the line search finds no way (without continuation frame 1
// fails).
TEST(NewtonTest, ContinuationSolvesViolentSteps) {
  const Scene scene =
      SmallScene(ScenePreset::kFlag, IntegrationMethod::kImplicitEuler, 0.5);
  Simulator simulator(scene);
  const Trajectory trajectory = simulator.Simulate(26);
  ASSERT_TRUE(trajectory.status.ok()) << trajectory.status.Message();
  // And what it found solves the step's own equation.
  const Eigen::VectorXd parameters = simulator.layout().Extract(scene);
  for (int frame = 1; frame < trajectory.num_frames(); ++frame) {
    Eigen::VectorXd residual;
    std::vector<Eigen::Triplet<double>> jacobian;
    const auto& x = trajectory.positions[0];
    const auto& v = trajectory.velocities[0];
    simulator.StepResidual(0, scene.step_length(), x.col(frame - 1), v.col(frame - 1),
                           x.col(frame), v.col(frame), parameters, &residual,
                           &jacobian);
    // kg m/s; the weight's part counts where the cloth has come to rest.
    const double momentum = scene.objects[0].mass.maxCoeff() *
                            (v.col(frame).norm() + 9.81 * scene.step_length());
    EXPECT_LT(residual.norm(), 1e-9 * momentum) << "frame " << frame;
  }
}

TEST(NewtonTest, ContinuationServesBothStagesOfTrBdf2) {
  const Scene scene = SmallScene(ScenePreset::kFlag, IntegrationMethod::kTrBdf2, 0.1);
  const Trajectory trajectory = Simulator(scene).Simulate(30);
  EXPECT_TRUE(trajectory.status.ok()) << trajectory.status.Message();
}

// At rest all forces cancel: what is left of the residual is the rounding of forces
// 1e13 times its size.
TEST(NewtonTest, AClothAtRestIsNoFailure) {
  for (const IntegrationMethod method :
       {IntegrationMethod::kImplicitEuler, IntegrationMethod::kTrBdf2}) {
    const Scene scene = SmallScene(ScenePreset::kCorners, method, 0.5);
    const Trajectory trajectory = Simulator(scene).Simulate(60);
    ASSERT_TRUE(trajectory.status.ok()) << trajectory.status.Message();
    EXPECT_LT(trajectory.velocities[0].col(59).cwiseAbs().maxCoeff(), 1e-4);
  }
}

}  // namespace
}  // namespace dpe::test
