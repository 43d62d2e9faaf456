// Rest lengths of their own: a motion that starts from any shape of the cloth.
#include <gtest/gtest.h>

#include <cmath>

#include "dpe/engine/scene_io.h"
#include "dpe/engine/simulator.h"
#include "support/test_scenes.h"

namespace dpe::test {
namespace {

Trajectory MustSimulate(const Scene& scene, int num_frames) {
  const Trajectory trajectory = Simulator(scene).Simulate(num_frames);
  EXPECT_TRUE(trajectory.status.ok()) << trajectory.status.Message();
  return trajectory;
}

// A mass that hangs 2 m below a pin on a spring of a rest length of 1.5 m, not moving.
TEST(RestLength, TheForceOfASpringIsThatOfItsOwnRestLength) {
  ClothObject cloth;
  cloth.positions.resize(6);
  cloth.positions << 0.0, 0.0, 0.0, 0.0, -2.0, 0.0;
  cloth.velocities = Eigen::VectorXd::Zero(6);
  cloth.is_fixed = {1, 0};
  cloth.mass = Eigen::Vector2d(1.0, 1.0);
  cloth.springs = {{0, 1}};
  cloth.rest_length = Eigen::VectorXd::Constant(1, 1.5);
  cloth.stiffness = Eigen::VectorXd::Constant(1, 9.81 / 0.5);
  Scene scene;
  scene.objects = {cloth};
  const Trajectory hangs = MustSimulate(scene, 20);
  EXPECT_LT((hangs.positions[0].col(19) - cloth.positions).norm(), 1e-12);
  scene.objects[0].rest_length[0] = 1.6;
  EXPECT_LT(MustSimulate(scene, 20).positions[0].col(19)[4], -2.01);
}

class RestLengthTest : public testing::TestWithParam<std::string> {};

TEST_P(RestLengthTest, WithoutThemSpringsAreAtRestInPositions) {
  Scene scene = MakeDerivativeScene(GetParam(), 5);
  Perturb(4, &scene);
  const Trajectory without = MustSimulate(scene, 8);
  for (ClothObject& object : scene.objects) object.rest_length = RestLengths(object);
  const Trajectory with = MustSimulate(scene, 8);
  EXPECT_EQ(without.positions, with.positions);
  EXPECT_EQ(without.velocities, with.velocities);
}

TEST_P(RestLengthTest, AMotionContinuesFromAnyOfItsFrames) {
  constexpr int kStart = 6, kFrames = 14;
  Scene scene = MakeDerivativeScene(GetParam(), 5);
  Perturb(4, &scene);
  // Paths are given from frame 0 on.
  for (ClothObject& object : scene.objects) object.prescribed_paths.clear();
  const Trajectory whole = MustSimulate(scene, kFrames);
  Scene later = scene;
  for (size_t o = 0; o < scene.objects.size(); ++o) {
    later.objects[o].rest_length = RestLengths(scene.objects[o]);
    later.objects[o].positions = whole.positions[o].col(kStart);
    later.objects[o].velocities = whole.velocities[o].col(kStart);
  }
  // As a file would have it.
  const Trajectory part =
      MustSimulate(ParseScene(SceneToJson(later), "later"), kFrames - kStart);
  for (size_t o = 0; o < scene.objects.size(); ++o) {
    EXPECT_EQ(part.positions[o], whole.positions[o].rightCols(kFrames - kStart));
    EXPECT_EQ(part.velocities[o], whole.velocities[o].rightCols(kFrames - kStart));
  }
  later.objects[0].rest_length.resize(0);
  EXPECT_GT((MustSimulate(later, kFrames - kStart).positions[0].col(5) -
             whole.positions[0].col(kStart + 5))
                .norm(),
            1e-6);
}

INSTANTIATE_TEST_SUITE_P(Scenes, RestLengthTest,
                         testing::ValuesIn(DerivativeSceneNames()),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace dpe::test
