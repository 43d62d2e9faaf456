// The scenes of hard contact are in contact, and the predicted limits of explicit steps
// see it.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/simulator.h"
#include "experiments/stability/contact.h"
#include "experiments/stability/stability_scene.h"
#include "experiments/stability/step_limit.h"

namespace dpe::experiments {
namespace {

constexpr double kStiffness = 1e5;  // N/m
constexpr double kMass = 0.2;       // kg

// One free vertex, 1 m above a plane that it may fall on.
Scene PointOverPlane() {
  Scene scene;
  scene.integration_method = IntegrationMethod::kSymplecticEuler;
  ClothObject object;
  object.positions.setZero(3);
  object.positions[1] = 1.0;
  object.velocities.setZero(3);
  object.is_fixed = {0};
  object.mass.setConstant(1, kMass);
  scene.objects.push_back(object);
  Collider plane;
  plane.type = ColliderType::kPlane;
  plane.stiffness = kStiffness;
  scene.colliders = {plane};
  return scene;
}

TEST(ContactProbeTest, DepthsAreThoseOfTheGeometry) {
  Scene scene = PointOverPlane();
  EXPECT_EQ(ContactProbe(scene).Depths(Eigen::Vector3d(0.3, 0.1, 0.2))[0], 0.0);
  EXPECT_NEAR(ContactProbe(scene).Depths(Eigen::Vector3d(0.3, -0.02, 0.2))[0], 0.02,
              1e-12);
  scene.colliders = {SphereCollider({1.0, 2.0, 3.0}, 0.5)};
  EXPECT_EQ(ContactProbe(scene).Depths(Eigen::Vector3d(1.0, 2.51, 3.0))[0], 0.0);
  EXPECT_NEAR(ContactProbe(scene).Depths(Eigen::Vector3d(1.0, 2.0, 3.4))[0], 0.1,
              1e-12);
  scene.colliders.clear();
  EXPECT_EQ(ContactProbe(scene).Depths(Eigen::Vector3d(1.0, 2.0, 3.4))[0], 0.0);
}

TEST(ContactScenesTest, TheColliderIsHitAtEveryStiffness) {
  int scenes = 0;
  for (const StabilityAxis& axis : StabilityAxes()) {
    if (axis.name != "plane" && axis.name != "sphere") continue;
    for (double value : axis.values) {
      SCOPED_TRACE(axis.name + " " + std::to_string(value));
      StabilityScene s = MakeStabilityScene(axis.name, value);
      s.scene.integration_method = IntegrationMethod::kImplicitEuler;
      ASSERT_EQ(s.scene.colliders.size(), 1u);
      ASSERT_EQ(s.scene.colliders[0].stiffness, value);
      const ContactProbe probe(s.scene);
      EXPECT_EQ(probe.Depths(s.scene.objects[0].positions).maxCoeff(), 0.0);
      // Also in the frames that are differentiated.
      const Trajectory trajectory = Simulator(s.scene).Simulate(s.gradient_frames);
      ASSERT_TRUE(trajectory.status.ok()) << trajectory.status.Message();
      const Eigen::MatrixXd& x = trajectory.positions[0];
      EXPECT_GT(probe.Deepest(x), 1e-3 / value);
      Eigen::VectorXd touched = Eigen::VectorXd::Zero(x.rows() / 3);
      for (int f = 0; f < x.cols(); ++f)
        touched = touched.cwiseMax(probe.Depths(x.col(f)));
      EXPECT_GE((touched.array() > 0.0).count(), 3);
      ++scenes;
    }
  }
  EXPECT_EQ(scenes, 7);
}

TEST(ContactStatesTest, AreThoseInWhichOtherVerticesTouch) {
  const Scene scene = PointOverPlane();
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(3, 6);
  x.row(1) << 0.1, -0.01, -0.02, 0.1, -0.01, 0.2;
  const std::vector<ContactState> states = ContactStates(scene, x, 8);
  ASSERT_EQ(states.size(), 1u);
  EXPECT_EQ(states[0].frame, 1);
  EXPECT_EQ(states[0].count, 3);
  EXPECT_EQ(states[0].touching, std::vector<bool>{true});
}

// Without contact nothing limits a free vertex; in contact its frequency is that of
// the mass on the penalty's spring, and it counts with the time it takes.
TEST(ContactLimitTest, IsThatOfTheMassOnThePenalty) {
  Scene scene = PointOverPlane();
  const double limit = 2.0 * std::sqrt(kMass / kStiffness);
  scene.delta = 2.0 * limit;
  Eigen::MatrixXd apart = Eigen::MatrixXd::Zero(3, 11);
  apart.row(1).setConstant(1.0);
  EXPECT_GT(PredictStepLimitAlong(scene, apart, apart).limit, 1.0);
  Eigen::MatrixXd touching = apart;
  touching(1, 4) = -0.001;
  const StepLimit predicted = PredictStepLimitAlong(scene, apart, touching);
  EXPECT_NEAR(predicted.limit, limit, 2e-3 * limit);
  EXPECT_NEAR(predicted.omega_max, std::sqrt(kStiffness / kMass),
              1e-3 * std::sqrt(kStiffness / kMass));
  // h w = 4: z^2 - (2 - 16) z + 1 = 0, one step of ten.
  EXPECT_NEAR(std::log(predicted.factor), 0.1 * std::log(7.0 + std::sqrt(48.0)), 1e-3);
}

// At what speed (m/s) a vertex that falls at 1 m/s onto a plane leaves it, where the
// contact takes a sixth of a frame of 2 ms.
double BounceSpeed(IntegrationMethod method, int steps_per_frame) {
  Scene scene = PointOverPlane();
  scene.integration_method = method;
  scene.steps_per_frame = steps_per_frame;
  scene.delta = 0.002;
  scene.gravity.setZero();
  scene.colliders[0].stiffness = 1e7;
  ClothObject& object = scene.objects[0];
  object.mass.setConstant(0.1);
  object.positions[1] = 0.0213;
  object.velocities[1] = -1.0;
  const Trajectory trajectory = Simulator(scene).Simulate(30);
  EXPECT_TRUE(trajectory.status.ok()) << trajectory.status.Message();
  return trajectory.velocities[0](1, 29);
}

// What the report says of contacts that are over within a step.
TEST(HardContactTest, BackwardEulerStopsWhatBouncesAndTrBdf2DoesNot) {
  const auto bdf2 = IntegrationMethod::kTrBdf2;
  EXPECT_NEAR(BounceSpeed(IntegrationMethod::kSymplecticEuler, 64), 1.0, 1e-3);
  EXPECT_NEAR(BounceSpeed(bdf2, 64), 1.0, 1e-3);
  EXPECT_NEAR(BounceSpeed(IntegrationMethod::kLinearlyImplicitEuler, 1), 0.0, 0.01);
  EXPECT_NEAR(BounceSpeed(IntegrationMethod::kImplicitEuler, 1), 0.0, 0.01);
  EXPECT_GT(BounceSpeed(bdf2, 1), 1.1);
}

}  // namespace
}  // namespace dpe::experiments
