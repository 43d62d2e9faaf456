// Rollouts that cannot go on say why, with words that a user can act on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "dpe/engine/simulator.h"
#include "support/integration_methods.h"
#include "support/test_scenes.h"

namespace dpe::test {
namespace {

using testing::HasSubstr;

class NamedFailuresTest : public testing::TestWithParam<IntegrationMethod> {};

// The free end of a spring without stiffness comes to the very place of the fixed one,
// in 8 steps whose every position is an exact number.
Scene MeetingEnds(IntegrationMethod method) {
  Scene scene;
  scene.integration_method = method;
  scene.delta = 1.0 / 64.0;
  scene.gravity.setZero();
  ClothObject object;
  object.positions.resize(9);
  object.positions << 5.0, 5.0, 5.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0;
  object.velocities.setZero(9);
  object.velocities[6] = -8.0;
  object.is_fixed = {1, 1, 0};
  object.mass.setOnes(3);
  object.springs = {{0, 2}, {1, 2}};
  object.stiffness = Eigen::Vector2d::Zero();
  object.rest_length = Eigen::Vector2d::Ones();
  scene.objects.push_back(object);
  return scene;
}

TEST_P(NamedFailuresTest, EndsOfASpringThatMeetAreNamed) {
  // TR-BDF2's inner state is no exact number: it passes by.
  if (GetParam() == IntegrationMethod::kTrBdf2) GTEST_SKIP();
  for (const char* solver : {"cholesky", "cg"}) {
    Scene scene = MeetingEnds(GetParam());
    scene.solver = solver;
    const Trajectory trajectory = Simulator(scene).Simulate(20);
    const RolloutStatus& status = trajectory.status;
    EXPECT_EQ(status.code, RolloutStatus::Code::kNotFinite);
    EXPECT_THAT(status.Message(), HasSubstr("the ends of spring 1, vertices 1 and 2"));
    // The step that arrives there, or the one that goes on.
    EXPECT_GE(status.frame, 8);
    EXPECT_LE(status.frame, 9);
    EXPECT_TRUE(trajectory.positions[0].leftCols(status.frame).allFinite());
    EXPECT_TRUE(std::isnan(trajectory.positions[0](6, status.frame)));
  }
}

TEST_P(NamedFailuresTest, ADivergedRolloutSaysWhatToDo) {
  Scene scene = MakeDerivativeScene("side", 4);
  scene.integration_method = GetParam();
  scene.delta = 0.5;
  scene.objects[0].stiffness *= 1e4;
  const RolloutStatus status = Simulator(scene).Simulate(100).status;
  if (status.ok()) return;  // the implicit methods
  EXPECT_GT(status.frame, 0);
  EXPECT_FALSE(status.reason.empty());
  const std::string name = IntegrationMethodName(GetParam());
  if (name == "explicit_euler" || name == "symplectic_euler") {
    EXPECT_THAT(status.reason, HasSubstr(name + " is unstable for steps h longer"));
  }
}

TEST(NamedFailures, ExplicitMethodsDoDivergeThere) {
  for (auto method :
       {IntegrationMethod::kExplicitEuler, IntegrationMethod::kSymplecticEuler}) {
    Scene scene = MakeDerivativeScene("side", 4);
    scene.integration_method = method;
    scene.delta = 0.5;
    scene.objects[0].stiffness *= 1e4;
    EXPECT_EQ(Simulator(scene).Simulate(100).status.code,
              RolloutStatus::Code::kNotFinite);
  }
}

INSTANTIATE_TEST_SUITE_P(AllMethods, NamedFailuresTest, AllIntegrationMethods(),
                         MethodCaseName);

}  // namespace
}  // namespace dpe::test
