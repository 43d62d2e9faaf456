#include "dpe/engine/parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dpe/engine/cloth_builder.h"

namespace dpe::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Vertices 0 and 1 fixed, 2 and 3 free; spring 1 joins the fixed ones.
Scene SmallScene() {
  ClothObject cloth;
  cloth.is_fixed = {1, 1, 0, 0};
  cloth.positions.resize(12);
  cloth.positions << 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0;
  cloth.velocities = Eigen::VectorXd::LinSpaced(12, 1.0, 12.0);
  cloth.mass = Eigen::Vector4d(1.0, 2.0, 3.0, 5.0);
  cloth.springs = {{0, 2}, {0, 1}, {2, 3}, {1, 3}};
  cloth.stiffness = Eigen::Vector4d(10.0, 20.0, 30.0, 80.0);
  cloth.triangles = {{0, 1, 2}};
  cloth.damping = 0.3;
  cloth.drag_coefficient = 0.4;
  Scene scene;
  scene.wind = {1.0, 2.0, 3.0};
  scene.objects = {cloth};
  return scene;
}

TEST(ParameterLayout, LocalBlocksHoldTheElementsWithInfluenceInOrder) {
  Scene scene = SmallScene();
  ApplySettings("LL", &scene);
  const ParameterLayout layout(scene);
  ASSERT_EQ(layout.blocks().size(), 2);
  const ParameterBlock& mass = layout.blocks()[0];
  EXPECT_EQ(mass.kind, ParameterKind::kMass);
  EXPECT_EQ(mass.object, 0);
  EXPECT_EQ(mass.offset, 0);
  EXPECT_EQ(mass.size, 2);
  EXPECT_THAT(mass.element_to_local, ElementsAre(-1, -1, 0, 1));
  const ParameterBlock& stiffness = layout.blocks()[1];
  EXPECT_EQ(stiffness.kind, ParameterKind::kStiffness);
  EXPECT_EQ(stiffness.offset, 2);
  EXPECT_EQ(stiffness.size, 3);
  EXPECT_THAT(stiffness.element_to_local, ElementsAre(0, -1, 1, 2));
  EXPECT_EQ(layout.size(), 5);
  const Eigen::VectorXd p = layout.Extract(scene);
  EXPECT_THAT(std::vector<double>(p.begin(), p.end()),
              ElementsAre(3.0, 5.0, 10.0, 30.0, 80.0));
}

TEST(ParameterLayout, GlobalBlocksAreTheMeanOfTheElementsWithInfluence) {
  Scene scene = SmallScene();
  ApplySettings("GG", &scene);
  const ParameterLayout layout(scene);
  EXPECT_EQ(layout.Extract(scene), Eigen::Vector2d(4.0, 40.0));
  EXPECT_THAT(layout.blocks()[1].element_to_local, ElementsAre(0, -1, 0, 0));
}

TEST(ParameterLayout, GroupBlocksAreSortedByGroupNumber) {
  Scene scene = SmallScene();
  ApplySettings("nR", &scene);
  scene.objects[0].spring_group = {9, 1, 4, 9};  // group 1 has no influence
  const ParameterLayout layout(scene);
  ASSERT_EQ(layout.blocks().size(), 1);
  EXPECT_EQ(layout.blocks()[0].size, 2);
  EXPECT_THAT(layout.blocks()[0].element_to_local, ElementsAre(1, -1, 0, 1));
  EXPECT_EQ(layout.Extract(scene), Eigen::Vector2d(30.0, 45.0));
}

TEST(ParameterLayout, OtherQuantitiesFollowInTheirOrder) {
  Scene scene = SmallScene();
  scene.objects.push_back(scene.objects[0]);
  ApplySettings("nn,Gn", &scene);
  scene.estimate_wind = true;
  scene.objects[0].estimate_damping = true;
  scene.objects[0].estimate_drag = true;
  scene.objects[0].estimate_initial_velocity = true;
  scene.objects[0].estimate_initial_position = true;
  const ParameterLayout layout(scene);
  ASSERT_EQ(layout.blocks().size(), 6);
  const ParameterKind kinds[] = {ParameterKind::kDamping,
                                 ParameterKind::kDrag,
                                 ParameterKind::kInitialVelocity,
                                 ParameterKind::kInitialPosition,
                                 ParameterKind::kMass,
                                 ParameterKind::kWind};
  const int objects[] = {0, 0, 0, 0, 1, -1};
  int offset = 0;
  for (int b = 0; b < 6; ++b) {
    EXPECT_EQ(layout.blocks()[b].kind, kinds[b]) << b;
    EXPECT_EQ(layout.blocks()[b].object, objects[b]) << b;
    EXPECT_EQ(layout.blocks()[b].offset, offset) << b;
    offset += layout.blocks()[b].size;
  }
  EXPECT_EQ(layout.size(), offset);
  EXPECT_EQ(layout.blocks()[0].mode, ParameterMode::kGlobal);
  EXPECT_EQ(layout.blocks()[1].mode, ParameterMode::kGlobal);
  for (int b : {2, 3}) {
    EXPECT_EQ(layout.blocks()[b].size, 6);  // three per free vertex
    EXPECT_THAT(layout.blocks()[b].element_to_local,
                ElementsAre(-1, -1, -1, -1, -1, -1, 0, 1, 2, 3, 4, 5));
  }
  Eigen::VectorXd expected(18);
  expected << 0.3, 0.4, 7, 8, 9, 10, 11, 12, 0, 1, 0, 1, 1, 0, 4, 1, 2, 3;
  EXPECT_EQ(layout.Extract(scene), expected);
}

TEST(ParameterLayout, InsertIsTheInverseOfExtract) {
  Scene scene = SmallScene();
  ApplySettings("LR", &scene);
  scene.estimate_wind = true;
  scene.objects[0].spring_group = {9, 1, 4, 9};
  scene.objects[0].estimate_damping = true;
  scene.objects[0].estimate_drag = true;
  scene.objects[0].estimate_initial_velocity = true;
  scene.objects[0].estimate_initial_position = true;
  const ParameterLayout layout(scene);
  const Eigen::VectorXd p = Eigen::VectorXd::LinSpaced(layout.size(), 0.1, 9.7);
  Scene changed = scene;
  layout.Insert(p, &changed);
  EXPECT_EQ(layout.Extract(changed), p);
  // Elements without influence keep their values.
  EXPECT_EQ(changed.objects[0].mass.head(2), scene.objects[0].mass.head(2));
  EXPECT_EQ(changed.objects[0].stiffness[1], scene.objects[0].stiffness[1]);
  EXPECT_EQ(changed.objects[0].velocities.head(6), scene.objects[0].velocities.head(6));
  EXPECT_EQ(changed.objects[0].positions.head(6), scene.objects[0].positions.head(6));
  EXPECT_NE(changed.objects[0].positions.tail(6), scene.objects[0].positions.tail(6));
  EXPECT_EQ(changed.objects[0].stiffness[0], changed.objects[0].stiffness[3]);
}

TEST(ParameterLayout, BlocksOfOtherSegmentsAreLeftAlone) {
  Scene scene = SmallScene();
  ApplySettings("nG", &scene);
  scene.objects[0].estimate_initial_velocity = true;
  std::vector<ParameterBlock> blocks = ParameterLayout(scene).blocks();
  blocks[1].segment = 0;
  blocks.push_back(blocks[1]);
  blocks[2].segment = 1;
  const ParameterLayout layout(blocks);
  EXPECT_EQ(layout.size(), 13);
  EXPECT_EQ(layout.blocks()[2].offset, 7);
  Eigen::VectorXd p = Eigen::VectorXd::LinSpaced(13, 1.0, 13.0);
  layout.Insert(p, &scene, 1);
  EXPECT_EQ(scene.objects[0].stiffness[0], 1.0);
  EXPECT_EQ(scene.objects[0].velocities.tail(6), p.tail(6));
  p.segment(1, 6).setZero();
  EXPECT_EQ(layout.Extract(scene, 1), p);
}

TEST(ParameterLayout, BlocksWithoutInfluenceAreLeftOut) {
  Scene scene = SmallScene();
  scene.objects[0].springs = {{0, 1}};
  scene.objects[0].stiffness = Eigen::VectorXd::Ones(1);
  scene.objects[0].triangles.clear();
  ApplySettings("nG", &scene);
  scene.objects[0].estimate_drag = true;
  scene.estimate_wind = true;
  const ParameterLayout layout(scene);
  EXPECT_THAT(layout.blocks(), IsEmpty());
  EXPECT_EQ(layout.size(), 0);
  EXPECT_FALSE(ParameterLayout::ObjectIsEstimated(scene, 0));
}

TEST(ParameterLayout, RepresentsTellsWhetherABlockCanExpressTheScene) {
  Scene scene = SmallScene();
  ApplySettings("LR", &scene);
  scene.objects[0].spring_group = {9, 1, 4, 9};
  EXPECT_TRUE(ParameterLayout(scene).Represents(scene, 0));
  EXPECT_FALSE(ParameterLayout(scene).Represents(scene, 1));  // 10 and 80 in group 9
  scene.objects[0].stiffness[3] = 10.0 * (1.0 + 1e-13);
  EXPECT_TRUE(ParameterLayout(scene).Represents(scene, 1));
  scene.objects[0].stiffness[3] = 10.0 * (1.0 + 1e-11);
  EXPECT_FALSE(ParameterLayout(scene).Represents(scene, 1));
}

TEST(ParameterLayout, EqualValuesHaveExactlyThatMean) {
  Scene scene = MakePresetScene(ScenePreset::kSide);
  scene.objects[0].stiffness.setConstant(0.1);
  ApplySettings("nG", &scene);
  EXPECT_EQ(ParameterLayout(scene).Extract(scene)[0], 0.1);
}

TEST(ParameterLayout, APresetHasThreeSpringGroupsAndNoPinnedParameters) {
  Scene scene = MakePresetScene(ScenePreset::kSide);
  ApplySettings("LL", &scene);
  // 144 vertices, 12 of them fixed; 726 springs, of which 11 join fixed neighbours.
  const ParameterLayout local(scene);
  EXPECT_EQ(local.blocks()[0].size, 132);
  EXPECT_EQ(local.blocks()[1].size, 715);
  ApplySettings("nR", &scene);
  EXPECT_EQ(ParameterLayout(scene).size(), 3);
}

TEST(ObjectIsEstimated, IfItHasAParameterOrFeelsAnEstimatedWind) {
  Scene scene = SmallScene();
  scene.objects.push_back(scene.objects[0]);
  scene.objects.push_back(scene.objects[0]);
  scene.objects[2].drag_coefficient = 0.0;
  ApplySettings("nn,nL", &scene);
  EXPECT_FALSE(ParameterLayout::ObjectIsEstimated(scene, 0));
  EXPECT_TRUE(ParameterLayout::ObjectIsEstimated(scene, 1));
  scene.estimate_wind = true;
  EXPECT_TRUE(ParameterLayout::ObjectIsEstimated(scene, 0));
  EXPECT_FALSE(ParameterLayout::ObjectIsEstimated(scene, 2));
}

TEST(ParameterKinds, HaveNameUnitAndSign) {
  EXPECT_EQ(ParameterKindName(ParameterKind::kStiffness), "stiffness");
  EXPECT_EQ(ParameterKindUnit(ParameterKind::kStiffness), "N/m");
  EXPECT_EQ(ParameterKindUnit(ParameterKind::kMass), "kg");
  EXPECT_EQ(ParameterKindUnit(ParameterKind::kDrag), "1");
  EXPECT_TRUE(ParameterKindIsPositive(ParameterKind::kDrag));
  EXPECT_FALSE(ParameterKindIsPositive(ParameterKind::kWind));
  EXPECT_FALSE(ParameterKindIsPositive(ParameterKind::kInitialVelocity));
  EXPECT_EQ(ParameterKindName(ParameterKind::kInitialPosition), "initial position");
  EXPECT_EQ(ParameterKindUnit(ParameterKind::kInitialPosition), "m");
  EXPECT_FALSE(ParameterKindIsPositive(ParameterKind::kInitialPosition));
}

}  // namespace
}  // namespace dpe::test
