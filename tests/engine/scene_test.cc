#include "dpe/engine/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dpe::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Scene SceneOfObjects(int count) {
  Scene scene;
  scene.objects.resize(count);
  return scene;
}

template <typename Action>
std::string ErrorOf(Action action) {
  try {
    action();
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(SettingsLetters, AreReadInEitherCase) {
  for (const char* letters : {"nN", "Gg", "Ll", "Rr"}) {
    EXPECT_EQ(ParameterModeFromLetter(letters[0]), ParameterModeFromLetter(letters[1]));
    EXPECT_EQ(ParameterModeLetter(ParameterModeFromLetter(letters[0])), letters[0]);
  }
  EXPECT_THAT(ErrorOf([] { ParameterModeFromLetter('x'); }),
              AllOf(HasSubstr("\"x\""), HasSubstr("G (one value per object)")));
}

TEST(Settings, ApplyToObjectsInOrderAndTheRestIsFixed) {
  Scene scene = SceneOfObjects(3);
  scene.objects[2].mass_mode = ParameterMode::kGlobal;
  ApplySettings("nL,Rg", &scene);
  EXPECT_EQ(scene.objects[0].mass_mode, ParameterMode::kFixed);
  EXPECT_EQ(scene.objects[0].stiffness_mode, ParameterMode::kLocal);
  EXPECT_EQ(scene.objects[1].mass_mode, ParameterMode::kGroup);
  EXPECT_EQ(scene.objects[1].stiffness_mode, ParameterMode::kGlobal);
  EXPECT_EQ(scene.objects[2].mass_mode, ParameterMode::kFixed);
  EXPECT_EQ(SettingsString(scene), "nL,RG");
  ApplySettings("", &scene);
  EXPECT_EQ(SettingsString(scene), "");
}

TEST(Settings, TheirTextLeavesOutOnlyTrailingFixedObjects) {
  Scene scene = SceneOfObjects(4);
  ApplySettings("nn,nn,Ln,nn", &scene);
  EXPECT_EQ(SettingsString(scene), "nn,nn,Ln");
}

TEST(Settings, WrongOnesAreRefusedAndChangeNothing) {
  Scene scene = SceneOfObjects(2);
  ApplySettings("LL", &scene);
  for (const char* wrong : {"n", "nLn", "nL,", ",nL", "nL nn", "nQ", "nL,nn,nn"}) {
    EXPECT_THROW(ApplySettings(wrong, &scene), SceneError) << wrong;
    EXPECT_EQ(SettingsString(scene), "LL") << wrong;
  }
  EXPECT_THAT(ErrorOf([&] { ApplySettings("nL,nn,nn", &scene); }),
              AllOf(HasSubstr("3 objects"), HasSubstr("the scene has 2")));
}

TEST(IntegrationMethods, AreNamedAndNumbered) {
  for (int number = 0; number <= 3; ++number) {
    const auto method = static_cast<IntegrationMethod>(number);
    EXPECT_EQ(IntegrationMethodFromName(std::to_string(number)), method);
    EXPECT_EQ(IntegrationMethodFromName(IntegrationMethodName(method)), method);
  }
  EXPECT_EQ(IntegrationMethodName(IntegrationMethod::kLinearlyImplicitEuler),
            "linearly_implicit_euler");
  EXPECT_THAT(ErrorOf([] { IntegrationMethodFromName("rk4"); }),
              AllOf(HasSubstr("\"rk4\""), HasSubstr("3 implicit_euler")));
}

TEST(Groups, ComeFromGroupsElseFromKindsElseAreOne) {
  ClothObject object;
  object.is_fixed = {0, 0, 0};
  object.springs = {{0, 1}, {1, 2}};
  EXPECT_THAT(SpringGroups(object), ElementsAre(0, 0));
  EXPECT_THAT(VertexGroups(object), ElementsAre(0, 0, 0));
  object.spring_kind = {SpringKind::kBend, SpringKind::kStretch};
  EXPECT_NE(SpringGroups(object)[0], SpringGroups(object)[1]);
  object.spring_group = {7, 7};
  object.vertex_group = {1, 2, 1};
  EXPECT_THAT(SpringGroups(object), ElementsAre(7, 7));
  EXPECT_THAT(VertexGroups(object), ElementsAre(1, 2, 1));
}

}  // namespace
}  // namespace dpe::test
