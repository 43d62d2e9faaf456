#include "dpe/estimation/joint_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "segment_support.h"

namespace dpe {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<const Scene*> Pointers(const std::vector<Scene>& scenes) {
  std::vector<const Scene*> pointers;
  for (const Scene& scene : scenes) pointers.push_back(&scene);
  return pointers;
}

std::vector<Scene> Scenes(const std::string& settings) {
  std::vector<Scene> scenes = test::SideAndCorners();
  for (Scene& scene : scenes) ApplySettings(settings, &scene);
  return scenes;
}

TEST(JointLayout, OfOneSceneIsTheSceneSOwn) {
  Scene scene = test::MakeDerivativeScene("two_objects", 4);
  test::EstimateEverything(ParameterMode::kLocal, &scene);
  const ParameterLayout own(scene);
  const JointLayout joint({&scene}, true);
  ASSERT_EQ(joint.layout().blocks().size(), own.blocks().size());
  for (size_t b = 0; b < own.blocks().size(); ++b) {
    EXPECT_EQ(joint.layout().blocks()[b].kind, own.blocks()[b].kind);
    EXPECT_EQ(joint.layout().blocks()[b].segment, -1);
    EXPECT_EQ(joint.blocks(0)[b], static_cast<int>(b));
  }
  const Eigen::VectorXd p = own.Extract(scene);
  EXPECT_EQ(joint.Extract({&scene}), p);
  EXPECT_EQ(joint.Gather(p, 0), p);
}

TEST(JointLayout, LocalBlocksHoldWhatHasInfluenceInAnySegment) {
  const std::vector<Scene> scenes = Scenes("LL");
  const JointLayout joint(Pointers(scenes), false);
  ASSERT_EQ(joint.layout().blocks().size(), 2);
  const ParameterBlock& mass = joint.layout().blocks()[0];
  EXPECT_EQ(mass.size, 15);  // of 16; the first scene has 12, the second 14
  EXPECT_EQ(mass.element_to_local[12], -1);
  EXPECT_EQ(mass.element_to_local[13], 12);
  EXPECT_EQ(ParameterLayout(scenes[0]).blocks()[0].size, 12);
  EXPECT_EQ(joint.layout().blocks()[1].size, scenes[0].objects[0].num_springs());
  for (int s = 0; s < 2; ++s) {
    const ParameterLayout own(scenes[s]);
    EXPECT_THAT(joint.blocks(s), ElementsAre(0, 1));
    for (size_t b = 0; b < 2; ++b) {
      const ParameterBlock& block = own.blocks()[b];
      const ParameterBlock& shared = joint.layout().blocks()[b];
      for (size_t e = 0; e < block.element_to_local.size(); ++e) {
        if (block.element_to_local[e] < 0) continue;
        EXPECT_EQ(joint.indices(s)[block.offset + block.element_to_local[e]],
                  shared.offset + shared.element_to_local[e]);
      }
    }
    EXPECT_EQ(joint.Gather(joint.Extract(Pointers(scenes)), s), own.Extract(scenes[s]));
  }
}

TEST(JointLayout, GroupsAreFoundByTheirNumberNotTheirPlace) {
  std::vector<Scene> scenes = Scenes("nR");
  // The springs of the side alone have a group of their own: the first scene, in which
  // both ends are fixed, does not know it.
  for (Scene& scene : scenes) {
    ClothObject& cloth = scene.objects[0];
    cloth.spring_group.assign(cloth.num_springs(), 7);
    for (int s = 0; s < cloth.num_springs(); ++s) {
      if (cloth.springs[s][0] >= 12 && cloth.springs[s][1] >= 12) {
        cloth.spring_group[s] = 2;
      }
    }
  }
  const JointLayout joint(Pointers(scenes), false);
  EXPECT_EQ(joint.layout().size(), 2);
  EXPECT_THAT(joint.indices(0), ElementsAre(1));
  EXPECT_THAT(joint.indices(1), ElementsAre(0, 1));
}

TEST(JointLayout, InitialStatesAndWindsBelongToASegment) {
  std::vector<Scene> scenes = Scenes("nG");
  for (Scene& scene : scenes) scene.estimate_wind = true;
  scenes[0].objects[0].estimate_initial_velocity = true;
  scenes[1].objects[0].estimate_initial_velocity = true;
  scenes[1].objects[0].estimate_initial_position = true;
  for (Scene& scene : scenes) {
    scene.objects[0].rest_length = RestLengths(scene.objects[0]);
  }
  for (const bool own_wind : {false, true}) {
    const JointLayout joint(Pointers(scenes), own_wind);
    std::vector<int> segments;
    for (const ParameterBlock& b : joint.layout().blocks()) {
      segments.push_back(b.segment);
    }
    if (own_wind) {
      EXPECT_THAT(segments, ElementsAre(-1, 0, 0, 1, 1, 1));
      EXPECT_THAT(joint.blocks(0), ElementsAre(0, 1, 2));
      EXPECT_THAT(joint.blocks(1), ElementsAre(0, 3, 4, 5));
      EXPECT_EQ(joint.Extract(Pointers(scenes)).tail<3>(), scenes[1].wind);
    } else {
      EXPECT_THAT(segments, ElementsAre(-1, -1, 0, 1, 1));
      EXPECT_THAT(joint.blocks(0), ElementsAre(0, 1, 2));
      EXPECT_THAT(joint.blocks(1), ElementsAre(0, 1, 3, 4));
      EXPECT_EQ(joint.Extract(Pointers(scenes)).segment<3>(1), scenes[0].wind);
    }
    // What a segment's simulator is given is what the joint vector holds for it.
    const Eigen::VectorXd p =
        Eigen::VectorXd::LinSpaced(joint.layout().size(), 1.0, 2.0);
    for (int s = 0; s < 2; ++s) {
      Scene direct = scenes[s], own = scenes[s];
      joint.layout().Insert(p, &direct, s);
      ParameterLayout(own).Insert(joint.Gather(p, s), &own);
      EXPECT_EQ(direct.objects[0].velocities, own.objects[0].velocities);
      EXPECT_EQ(direct.objects[0].positions, own.objects[0].positions);
      EXPECT_EQ(direct.objects[0].stiffness[0], own.objects[0].stiffness[0]);
      EXPECT_EQ(direct.wind, own.wind);
    }
  }
}

TEST(JointLayout, AWindMayBeKnownInOneSegmentAndSoughtInAnother) {
  std::vector<Scene> scenes = Scenes("nG");
  scenes[1].estimate_wind = true;
  const JointLayout joint(Pointers(scenes), false);
  EXPECT_THAT(joint.blocks(0), ElementsAre(0));
  EXPECT_THAT(joint.blocks(1), ElementsAre(0, 1));
  EXPECT_EQ(joint.Extract(Pointers(scenes)).tail<3>(), scenes[1].wind);
}

// The mass of a vertex that is fixed in the first scene may be zero there.
TEST(JointLayout, ValuesComeFromASceneInWhichTheyHaveInfluence) {
  std::vector<Scene> scenes = Scenes("LL");
  scenes[0].objects[0].mass[13] = 0.0;
  for (int s = 0; s < scenes[0].objects[0].num_springs(); ++s) {
    const auto [a, b] = scenes[0].objects[0].springs[s];
    if (a >= 12 && b >= 12) scenes[0].objects[0].stiffness[s] = 0.0;
  }
  const JointLayout joint(Pointers(scenes), false);
  const Eigen::VectorXd p = joint.Extract(Pointers(scenes));
  EXPECT_EQ(p[12], scenes[1].objects[0].mass[13]);
  EXPECT_GT(p.minCoeff(), 0.0);
}

struct Difference {
  const char* what;
  std::function<void(Scene*)> make;
  const char* message;
};

TEST(JointLayout, OtherClothsAreRefused) {
  const Difference kDifferences[] = {
      {"objects", [](Scene* s) { s->objects.push_back(s->objects[0]); },
       "objects is 1 in scene 0 and 2 in scene 1"},
      {"vertices",
       [](Scene* s) {
         *s = test::MakeDerivativeScene("side", 5);
         ApplySettings("nL", s);
       },
       "objects[0].vertPos: the number of vertices is 16 in scene 0 and 25"},
      {"springs",
       [](Scene* s) { std::swap(s->objects[0].springs[0], s->objects[0].springs[1]); },
       "objects[0].springs[0] is 0-4 in scene 0 and 0-5"},
      {"triangles",
       [](Scene* s) {
         std::swap(s->objects[0].triangles[0], s->objects[0].triangles[1]);
       },
       "objects[0].triangles"},
      {"modes", [](Scene* s) { ApplySettings("nG", s); },
       "optimizationSettings is nL in scene 0 and nG"},
      {"damping", [](Scene* s) { s->objects[0].damping *= 1.1; },
       "objects[0].damping is"},
      {"drag", [](Scene* s) { s->objects[0].drag_coefficient *= 1.1; },
       "objects[0].dragCoefficient is"},
      {"law", [](Scene* s) { s->aerodynamics = AerodynamicsLaw::kUnitNormal; },
       "aerodynamics is authored in scene 0 and unit_normal"},
      {"what is estimated", [](Scene* s) { s->objects[0].estimate_damping = true; },
       "estimate.damping is false in scene 0 and true"},
      {"drag estimated", [](Scene* s) { s->objects[0].estimate_drag = true; },
       "estimate.dragCoefficient is false"},
      {"a mass that is known", [](Scene* s) { s->objects[0].mass[5] *= 2.0; },
       "objects[0].vertMass[5] is"},
      {"rest shape", [](Scene* s) { s->objects[0].positions *= 1.001; },
       "springs are at rest in its vertPos"},
  };
  for (const Difference& difference : kDifferences) {
    std::vector<Scene> scenes = Scenes("nL");
    difference.make(&scenes[1]);
    std::string message;
    try {
      JointLayout(Pointers(scenes), false);
    } catch (const SceneError& error) {
      message = error.what();
    }
    EXPECT_THAT(message, AllOf(HasSubstr("are not of the same cloths"),
                               HasSubstr(difference.message)))
        << difference.what;
  }
}

TEST(JointLayout, WhatIsEstimatedOrSaysNothingMayDiffer) {
  std::vector<Scene> scenes = Scenes("nL");
  ClothObject& cloth = scenes[1].objects[0];
  cloth.stiffness *= 2.0;                                 // estimated
  cloth.mass[3] = 0.0;                                    // fixed in this scene
  cloth.mass[14] = 5.0;                                   // fixed in the other
  cloth.rest_length = (1.0 + 1e-8) * RestLengths(cloth);  // rounded
  cloth.positions *= 1.5;                                 // not the rest shape any more
  EXPECT_EQ(JointLayout(Pointers(scenes), false).layout().size(), cloth.num_springs());
  // Groups matter to mode R alone.
  cloth.spring_group.assign(cloth.num_springs(), 3);
  EXPECT_NO_THROW(JointLayout(Pointers(scenes), false));
  for (Scene& scene : scenes) ApplySettings("nR", &scene);
  EXPECT_THROW(JointLayout(Pointers(scenes), false), SceneError);
}

TEST(JointLayout, PresetsOfOneClothMatch) {
  Scene side = MakePresetScene(ScenePreset::kSide);
  Scene corners = MakePresetScene(ScenePreset::kCorners);
  Scene flag = MakePresetScene(ScenePreset::kFlag);  // stands in another plane
  for (Scene* scene : {&side, &corners, &flag}) ApplySettings("nL", scene);
  const JointLayout joint({&side, &corners, &flag}, false);
  EXPECT_EQ(joint.layout().size(), 726);  // side alone has 715
}

}  // namespace
}  // namespace dpe
