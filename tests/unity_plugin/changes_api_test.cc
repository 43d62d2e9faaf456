#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "c_api_support.h"
#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/scene_io.h"
#include "dpe/engine/simulator.h"
#include "support/temp_dir.h"
#include "support/test_scenes.h"

namespace dpe::test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ChangesApiTest : public ::testing::Test {
 protected:
  ChangesApiTest() {
    EXPECT_DPE_OK(dpe_scene_create_from_json(DPE_C_VERSION, SceneToJson(given_).c_str(),
                                             &scene_));
  }

  std::vector<double> Get(int kind) {
    std::int32_t count = 0;
    std::vector<double> values(1000);
    EXPECT_DPE_OK(
        dpe_scene_get_parameter(scene_, 0, kind, values.data(), 1000, &count));
    values.resize(count);
    return values;
  }

  Eigen::VectorXf Now() {
    const ReadPositions read = Read(scene_, 0, given_.objects[0].num_vertices());
    return Eigen::VectorXf::Map(read.positions.data(), read.positions.size());
  }

  // Where the cloth is after some frames of a scene.
  static Eigen::VectorXf After(const Scene& scene, int frames) {
    return Simulator(scene).Simulate(frames + 1).positions[0].col(frames).cast<float>();
  }

  Scene given_ = MakeDerivativeScene("side", 4);
  OwnedScene scene_;
};

TEST_F(ChangesApiTest, ParametersAreThoseOfASceneThatHasThem) {
  Scene changed = given_;
  changed.objects[0].stiffness.setConstant(7.0);
  changed.objects[0].mass *= 1.5;
  changed.objects[0].damping = 0.3;
  changed.objects[0].drag_coefficient = 0.2;
  changed.wind = {1.0, 2.0, 3.0};
  const double stiffness = 7.0, damping = 0.3, drag = 0.2;
  ASSERT_DPE_OK(dpe_scene_set_parameter(scene_, 0, DPE_STIFFNESS, &stiffness, 1));
  ASSERT_DPE_OK(dpe_scene_set_parameter(scene_, 0, DPE_MASS,
                                        changed.objects[0].mass.data(),
                                        given_.objects[0].num_vertices()));
  ASSERT_DPE_OK(dpe_scene_set_parameter(scene_, 0, DPE_DAMPING, &damping, 1));
  ASSERT_DPE_OK(dpe_scene_set_parameter(scene_, 0, DPE_DRAG, &drag, 1));
  ASSERT_DPE_OK(dpe_scene_set_parameter(scene_, 0, DPE_WIND, changed.wind.data(), 3));
  EXPECT_EQ(Get(DPE_STIFFNESS).size(), given_.objects[0].num_springs());
  EXPECT_THAT(Get(DPE_STIFFNESS), Each(7.0));
  EXPECT_THAT(Get(DPE_WIND), ElementsAre(1.0, 2.0, 3.0));
  ASSERT_DPE_OK(dpe_scene_step(scene_, 6));
  EXPECT_EQ(Now(), After(changed, 6));
  // A stop keeps them.
  ASSERT_DPE_OK(dpe_scene_stop(scene_));
  ASSERT_DPE_OK(dpe_scene_step(scene_, 6));
  EXPECT_EQ(Now(), After(changed, 6));
}

TEST_F(ChangesApiTest, WrongParametersChangeNothing) {
  const double negative = -1.0;
  EXPECT_EQ(dpe_scene_set_parameter(scene_, 0, DPE_STIFFNESS, &negative, 1),
            DPE_ERROR_INPUT);
  EXPECT_THAT(LastError(scene_), HasSubstr("springStiffness"));
  EXPECT_EQ(dpe_scene_set_parameter(scene_, 0, DPE_WIND, &negative, 1),
            DPE_ERROR_ARGUMENT);
  EXPECT_EQ(dpe_scene_set_parameter(scene_, 1, DPE_MASS, &negative, 1),
            DPE_ERROR_ARGUMENT);
  EXPECT_EQ(dpe_scene_set_parameter(scene_, 0, 9, &negative, 1), DPE_ERROR_ARGUMENT);
  ASSERT_DPE_OK(dpe_scene_step(scene_, 4));
  EXPECT_EQ(Now(), After(given_, 4));
}

TEST_F(ChangesApiTest, TakesOverAnOptimisedScene) {
  const TempDir folder;
  Scene optimised = given_;
  optimised.objects[0].stiffness *= 3.0;
  SaveScene(optimised, folder.File("optimised.txt"));
  ASSERT_DPE_OK(dpe_scene_load_optimized(scene_, folder.File("optimised.txt").c_str()));
  ASSERT_DPE_OK(dpe_scene_step(scene_, 5));
  EXPECT_EQ(Now(), After(optimised, 5));
  SaveScene(MakeDerivativeScene("side", 5), folder.File("other.txt"));
  EXPECT_EQ(dpe_scene_load_optimized(scene_, folder.File("other.txt").c_str()),
            DPE_ERROR_INPUT);
  EXPECT_THAT(LastError(scene_), HasSubstr("not the same cloth"));
}

TEST_F(ChangesApiTest, CollidersComeAndMoveAndGo) {
  dpe_collider sphere = {};
  sphere.type = DPE_SPHERE;
  sphere.position[1] = -1.0;
  sphere.radius = 2.0;
  sphere.stiffness = 500.0;
  std::int32_t id = -1;
  ASSERT_DPE_OK(dpe_scene_add_collider(scene_, &sphere, &id));
  Scene with = given_;
  with.colliders.push_back(SphereCollider({0.0, -1.0, 0.0}, 2.0));
  with.colliders[0].stiffness = 500.0;
  ASSERT_DPE_OK(dpe_scene_step(scene_, 5));
  EXPECT_EQ(Now(), After(with, 5));
  EXPECT_NE(Now(), After(given_, 5)) << "the sphere is not touched";

  std::int32_t other = -1;
  dpe_collider plane = sphere, read;
  plane.type = DPE_PLANE;
  ASSERT_DPE_OK(dpe_scene_add_collider(scene_, &plane, &other));
  ASSERT_DPE_OK(dpe_scene_remove_collider(scene_, id));
  EXPECT_EQ(dpe_scene_get_collider(scene_, id, &read), DPE_ERROR_ARGUMENT);
  plane.position[1] = -9.0;
  ASSERT_DPE_OK(dpe_scene_set_collider(scene_, other, &plane)) << "a name stays";
  ASSERT_DPE_OK(dpe_scene_get_collider(scene_, other, &read));
  EXPECT_EQ(read.position[1], -9.0);
  EXPECT_EQ(read.type, DPE_PLANE);
  sphere.radius = 0.0;
  EXPECT_EQ(dpe_scene_add_collider(scene_, &sphere, &id), DPE_ERROR_INPUT);
}

TEST_F(ChangesApiTest, FixedVerticesGoWhereTheyAreMoved) {
  const auto& fixed = given_.objects[0].is_fixed;
  const int pin =
      static_cast<int>(std::find(fixed.begin(), fixed.end(), 1) - fixed.begin());
  const Eigen::Vector3d to =
      given_.objects[0].positions.segment<3>(3 * pin) + Eigen::Vector3d(0, 0.5, 0);
  ASSERT_DPE_OK(dpe_scene_move_vertices(scene_, 0, &pin, to.data(), 1));
  ASSERT_DPE_OK(dpe_scene_step(scene_, 3));
  EXPECT_EQ(Now().segment<3>(3 * pin), to.cast<float>());
  // As a path of the scene says the same.
  Scene with = given_;
  PrescribedPath path;
  path.vertex = pin;
  path.positions.resize(3, 2);
  path.positions << given_.objects[0].positions.segment<3>(3 * pin), to;
  with.objects[0].prescribed_paths.push_back(path);
  EXPECT_EQ(Now(), After(with, 3));
  const int free = pin == 0 ? 4 : 0;
  ASSERT_FALSE(fixed[free]);
  EXPECT_EQ(dpe_scene_move_vertices(scene_, 0, &free, to.data(), 1),
            DPE_ERROR_ARGUMENT);
}

TEST_F(ChangesApiTest, VerticesAreFixedAndFreedOnTheWay) {
  ASSERT_DPE_OK(dpe_scene_step(scene_, 10));
  const int vertex = 1;
  ASSERT_FALSE(given_.objects[0].is_fixed[vertex]);
  const Eigen::Vector3f held = Now().segment<3>(3 * vertex);
  ASSERT_DPE_OK(dpe_scene_set_fixed(scene_, 0, vertex, 1));
  ASSERT_DPE_OK(dpe_scene_step(scene_, 10));
  EXPECT_EQ(Now().segment<3>(3 * vertex), held);
  dpe_object_info info;
  ASSERT_DPE_OK(dpe_scene_get_object_info(scene_, 0, &info));
  EXPECT_EQ(info.num_fixed, 5);
  ASSERT_DPE_OK(dpe_scene_set_fixed(scene_, 0, vertex, 0));
  ASSERT_DPE_OK(dpe_scene_step(scene_, 10));
  EXPECT_GT((Now().segment<3>(3 * vertex) - held).norm(), 1e-3);
  dpe_scene_info scene;
  ASSERT_DPE_OK(dpe_scene_get_info(scene_, &scene));
  EXPECT_EQ(scene.frame, 30);
  ASSERT_DPE_OK(dpe_scene_stop(scene_));
  ASSERT_DPE_OK(dpe_scene_step(scene_, 4));
  EXPECT_EQ(Now(), After(given_, 4)) << "a stop undoes it";
}

// Between fixing and freeing it again a vertex has only lost its velocity; where it had
// none, the motion goes on as if nothing had been.
TEST_F(ChangesApiTest, FixingAndFreeingAtRestChangesNothing) {
  const double drag = 0.0;
  ASSERT_DPE_OK(dpe_scene_set_parameter(scene_, 0, DPE_DRAG, &drag, 1));
  given_.objects[0].drag_coefficient = 0.0;
  ASSERT_DPE_OK(dpe_scene_set_fixed(scene_, 0, 1, 1));
  ASSERT_DPE_OK(dpe_scene_set_fixed(scene_, 0, 1, 0));
  ASSERT_DPE_OK(dpe_scene_step(scene_, 12));
  EXPECT_LT((Now() - After(given_, 12)).cwiseAbs().maxCoeff(), 1e-6f);
}

TEST_F(ChangesApiTest, LastFreeVertexCannotBeFixed) {
  const int n = given_.objects[0].num_vertices();
  int refused = 0;
  for (int i = 0; i < n; ++i) {
    refused += dpe_scene_set_fixed(scene_, 0, i, 1) == DPE_ERROR_INPUT;
  }
  EXPECT_EQ(refused, 1);
  ASSERT_DPE_OK(dpe_scene_step(scene_, 1));
}

}  // namespace
}  // namespace dpe::test
