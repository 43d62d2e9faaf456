// A live simulation's frames are those of Simulator::Simulate, bit for bit, and what is
// changed on its way acts as it would in a scene that had it from there on.
#include "dpe/engine/live_simulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/scene_io.h"
#include "support/integration_methods.h"
#include "support/test_scenes.h"

namespace dpe::test {
namespace {

Scene SceneFor(const std::string& name, IntegrationMethod method, int steps_per_frame) {
  Scene scene = MakeDerivativeScene(name, 6);
  scene.integration_method = method;
  scene.delta = 0.006;
  scene.steps_per_frame = steps_per_frame;
  return scene;
}

void Advance(int num_frames, LiveSimulation* live) {
  for (int f = 0; f < num_frames; ++f) {
    const RolloutStatus status = live->AdvanceFrame();
    ASSERT_TRUE(status.ok()) << status.Message();
  }
}

void ExpectFrame(const Trajectory& trajectory, int frame, const LiveSimulation& live) {
  for (int o = 0; o < live.num_objects(); ++o) {
    ASSERT_EQ(trajectory.positions[o].col(frame), live.positions(o)) << frame;
    ASSERT_EQ(trajectory.velocities[o].col(frame), live.velocities(o)) << frame;
  }
}

// The states after `num_frames` frames of `scene` that begin at those of `live`.
void ExpectSameFuture(Scene scene, int num_frames, LiveSimulation* live) {
  for (int o = 0; o < live->num_objects(); ++o) {
    ClothObject& cloth = scene.objects[o];
    cloth.rest_length = RestLengths(cloth);
    cloth.positions = live->positions(o);
    cloth.velocities = live->velocities(o);
    for (int i = 0; i < cloth.num_vertices(); ++i) {
      if (cloth.is_fixed[i]) cloth.velocities.segment<3>(3 * i).setZero();
    }
  }
  const Trajectory trajectory = Simulator(scene).Simulate(num_frames + 1);
  ASSERT_TRUE(trajectory.status.ok()) << trajectory.status.Message();
  for (int f = 1; f <= num_frames; ++f) {
    Advance(1, live);
    ExpectFrame(trajectory, f, *live);
  }
}

class LiveSimulationTest
    : public testing::TestWithParam<std::tuple<IntegrationMethod, std::string, int>> {
 protected:
  Scene MakeScene() const {
    return SceneFor(std::get<1>(GetParam()), std::get<0>(GetParam()),
                    std::get<2>(GetParam()));
  }
};

TEST_P(LiveSimulationTest, FramesAreThoseOfSimulate) {
  const Scene scene = MakeScene();
  const Trajectory trajectory = Simulator(scene).Simulate(15);
  ASSERT_TRUE(trajectory.status.ok()) << trajectory.status.Message();
  LiveSimulation live(scene);
  for (int f = 0; f < 15; ++f) {
    EXPECT_EQ(live.frame(), f);
    ExpectFrame(trajectory, f, live);
    Advance(1, &live);
  }
  live.Restart();
  EXPECT_EQ(live.frame(), 0);
  ExpectFrame(trajectory, 0, live);
  Advance(14, &live);
  ExpectFrame(trajectory, 14, live);
}

INSTANTIATE_TEST_SUITE_P(All, LiveSimulationTest,
                         testing::Combine(AllIntegrationMethods(),
                                          testing::Values("side", "collider",
                                                          "two_objects"),
                                          testing::Values(1, 3)),
                         [](const auto& info) {
                           return IntegrationMethodName(std::get<0>(info.param)) + "_" +
                                  std::get<1>(info.param) + "_" +
                                  std::to_string(std::get<2>(info.param));
                         });

TEST(LiveSimulationIterativeTest, FramesAreThoseOfSimulate) {
  // The Krylov method begins with what it remembers of the step before.
  for (const int steps_per_frame : {1, 3}) {
    Scene scene =
        SceneFor("flag", IntegrationMethod::kLinearlyImplicitEuler, steps_per_frame);
    scene.solver = "cg";
    const Trajectory trajectory = Simulator(scene).Simulate(12);
    LiveSimulation live(scene);
    for (int round = 0; round < 2; ++round) {
      live.Restart();
      Advance(11, &live);
      ExpectFrame(trajectory, 11, live);
    }
  }
}

class LiveChangesTest : public testing::TestWithParam<IntegrationMethod> {
 protected:
  LiveChangesTest() : scene_(SceneFor("collider", GetParam(), 2)) {}

  // Advances, changes, and compares with a scene that has been changed alike.
  void ExpectChange(const std::function<void(LiveSimulation*)>& change,
                    const std::function<void(Scene*)>& same_change) {
    LiveSimulation live(scene_), unchanged(scene_);
    Advance(4, &live);
    Advance(8, &unchanged);
    change(&live);
    Scene changed = scene_;
    same_change(&changed);
    EXPECT_EQ(SceneToJson(live.scene()), SceneToJson(changed));
    ExpectSameFuture(changed, 4, &live);
    // The change was one that is seen.
    EXPECT_GT((live.positions(0) - unchanged.positions(0)).cwiseAbs().maxCoeff(), 1e-7);
  }

  Scene scene_;
};

TEST_P(LiveChangesTest, Parameters) {
  const ClothObject& cloth = scene_.objects[0];
  const Eigen::VectorXd mass = 1.5 * cloth.mass, stiffness = 0.5 * cloth.stiffness;
  ExpectChange([&](LiveSimulation* live) { live->SetMass(0, mass); },
               [&](Scene* scene) { scene->objects[0].mass = mass; });
  ExpectChange([&](LiveSimulation* live) { live->SetStiffness(0, stiffness); },
               [&](Scene* scene) { scene->objects[0].stiffness = stiffness; });
  ExpectChange([](LiveSimulation* live) { live->SetDamping(0, 1.0); },
               [](Scene* scene) { scene->objects[0].damping = 1.0; });
  ExpectChange([](LiveSimulation* live) { live->SetDragCoefficient(0, 0.5); },
               [](Scene* scene) { scene->objects[0].drag_coefficient = 0.5; });
  ExpectChange(
      [](LiveSimulation* live) {
        live->SetWind({1.0, 2.0, 3.0});
      },
      [](Scene* scene) {
        scene->wind = {1.0, 2.0, 3.0};
      });
}

TEST_P(LiveChangesTest, DragWhereThereWasNone) {
  scene_.objects[0].drag_coefficient = 0.0;
  scene_.wind = {3.0, 1.0, 0.0};
  ExpectChange([](LiveSimulation* live) { live->SetDragCoefficient(0, 0.5); },
               [](Scene* scene) { scene->objects[0].drag_coefficient = 0.5; });
}

TEST_P(LiveChangesTest, Colliders) {
  std::vector<Collider> moved = scene_.colliders;
  moved[0].position.y() += 0.2;
  moved[1].type = ColliderType::kSphere;
  std::vector<Collider> more = moved;
  more.push_back(SphereCollider({1.0, -0.9, 1.0}, 1.0));
  for (const std::vector<Collider>& colliders : {moved, more}) {
    ExpectChange([&](LiveSimulation* live) { live->SetColliders(colliders); },
                 [&](Scene* scene) { scene->colliders = colliders; });
  }
  ExpectChange([](LiveSimulation* live) { live->SetColliders({}); },
               [](Scene* scene) { scene->colliders.clear(); });
}

TEST_P(LiveChangesTest, FixedVerticesGoWhereTheyAreSent) {
  Scene scene = SceneFor("side", GetParam(), 3);
  ClothObject& cloth = scene.objects[0];
  const int last = cloth.num_vertices() - 1;
  ASSERT_TRUE(cloth.is_fixed[last]);
  // The reference: a path.
  PrescribedPath path;
  path.vertex = last;
  path.positions.resize(3, 5);
  for (int f = 0; f < 5; ++f) {
    path.positions.col(f) = cloth.positions.segment<3>(3 * last) +
                            f * Eigen::Vector3d(0.01, -0.005, 0.002 * f);
  }
  Scene with_path = scene;
  with_path.objects[0].prescribed_paths.push_back(path);
  const Trajectory trajectory = Simulator(with_path).Simulate(8);
  LiveSimulation live(scene);
  for (int f = 1; f < 8; ++f) {
    if (f < 5) live.SetFixedPosition(0, last, path.positions.col(f));
    Advance(1, &live);
    // The path is interpolated from its beginning, a drive from its end.
    EXPECT_LT((live.positions(0) - trajectory.positions[0].col(f)).norm(), 1e-12);
    EXPECT_EQ((live.positions(0).segment<3>(3 * last)), path.At(f));
  }
  EXPECT_GT((trajectory.positions[0].col(7) -
             Simulator(scene).Simulate(8).positions[0].col(7))
                .head(3 * 6)
                .norm(),
            1e-9);
  // It overrides a path, until the start.
  LiveSimulation other(with_path);
  other.SetFixedPosition(0, last, cloth.positions.segment<3>(3 * last));
  Advance(3, &other);
  EXPECT_EQ(other.positions(0), Simulator(scene).Simulate(4).positions[0].col(3));
  other.Restart();
  Advance(3, &other);
  EXPECT_EQ(other.positions(0), trajectory.positions[0].col(3));
}

TEST_P(LiveChangesTest, StateIsTaken) {
  LiveSimulation live(scene_), other(scene_);
  Advance(5, &live);
  other.SetState(0, live.positions(0), live.velocities(0));
  ExpectSameFuture(scene_, 3, &other);
}

INSTANTIATE_TEST_SUITE_P(All, LiveChangesTest, AllIntegrationMethods(), MethodCaseName);

TEST(LiveFailureTest, KeepsTheStateAndGoesOnWhenTheReasonIsGone) {
  const Scene scene = SceneFor("side", IntegrationMethod::kExplicitEuler, 2);
  LiveSimulation live(scene);
  Advance(10, &live);
  live.SetStiffness(0, 1e12 * scene.objects[0].stiffness);
  RolloutStatus status;
  Eigen::VectorXd before;
  for (int f = 0; f < 50 && status.ok(); ++f) {
    before = live.positions(0);
    status = live.AdvanceFrame();
  }
  ASSERT_EQ(status.code, RolloutStatus::Code::kNotFinite);
  EXPECT_EQ(status.frame, live.frame() + 1);
  EXPECT_EQ(live.positions(0), before);
  EXPECT_TRUE(before.allFinite());
  live.SetStiffness(0, scene.objects[0].stiffness);
  live.Restart();
  Advance(10, &live);
  EXPECT_EQ(live.positions(0), Simulator(scene).Simulate(11).positions[0].col(10));
}

TEST(LiveFailureTest, OneObjectThatFailsHoldsTheOthers) {
  Scene scene = SceneFor("two_objects", IntegrationMethod::kExplicitEuler, 1);
  scene.objects[1].stiffness *= 1e12;
  LiveSimulation live(scene);
  RolloutStatus status;
  while (status.ok() && live.frame() < 100) status = live.AdvanceFrame();
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.object, 1);
  scene.objects[1].stiffness /= 1e12;
  const Trajectory trajectory = Simulator(scene).Simulate(live.frame() + 1);
  EXPECT_EQ(live.positions(0), trajectory.positions[0].col(live.frame()));
}

TEST(LiveErrorsTest, SettersNameWhatIsWrongAndChangeNothing) {
  const Scene scene = SceneFor("side", IntegrationMethod::kLinearlyImplicitEuler, 1);
  LiveSimulation live(scene);
  const ClothObject& cloth = scene.objects[0];
  Eigen::VectorXd mass = cloth.mass, stiffness = cloth.stiffness, x = cloth.positions;
  mass[0] = 0.0;
  stiffness[1] = -1.0;
  x[2] = std::numeric_limits<double>::quiet_NaN();
  const auto expect_error = [](const std::function<void()>& call, const char* what) {
    try {
      call();
      ADD_FAILURE() << "accepted: " << what;
    } catch (const SceneError& error) {
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos)
          << error.what();
    }
  };
  expect_error([&] { live.SetMass(0, mass); }, "objects[0].vertMass[0]");
  expect_error([&] { live.SetMass(0, mass.head(2)); }, "array of 2 entries");
  expect_error([&] { live.SetStiffness(0, stiffness); }, "springStiffness[1]: -1");
  expect_error([&] { live.SetDamping(0, -0.5); }, "objects[0].damping: -0.5");
  expect_error([&] { live.SetDragCoefficient(0, -1.0); }, "dragCoefficient");
  expect_error([&] { live.SetWind({0.0, INFINITY, 0.0}); }, "windVel.y");
  expect_error(
      [&] {
        live.SetColliders({SphereCollider({0, 0, 0}, -1.0)});
      },
      "colliders[0].scale.x");
  expect_error([&] { live.SetState(0, x, cloth.velocities); }, "vertPos");
  expect_error([&] { live.SetState(0, cloth.positions, x.head(6)); }, "vertVel");
  expect_error([&] { live.SetFixedPosition(0, 0, {0, 0, 0}); }, "a fixed vertex");
  expect_error([&] { live.SetFixedPosition(0, -1, {0, 0, 0}); }, "a fixed vertex");
  expect_error([&] { live.SetDamping(1, 0.5); }, "object 1");
  EXPECT_EQ(SceneToJson(live.scene()), SceneToJson(scene));
}

}  // namespace
}  // namespace dpe::test
