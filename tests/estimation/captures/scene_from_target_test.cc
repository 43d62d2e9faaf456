#include "dpe/estimation/scene_from_target.h"

#include "estimation/captures/capture_support.h"

namespace dpe::test {
namespace {

using ::testing::Each;

// Two squares; the first file is 2 % larger than the texture. Vertices 0 and 2 stand
// still, 6 belongs to no face.
constexpr char kFaces[] =
    "vt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\nvt 0 2\nvt 1 2\n"
    "f 1/1 2/2 4/4\nf 1/1 4/4 3/3\nf 3/3 4/4 6/6\nf 3/3 6/6 5/5\n";
constexpr char kFirst[] =
    "v 0 0 0\nv 1.02 0 0\nv 0 0 1.02\nv 1.02 0 1.02\nv 0 0 2.04\nv 1.02 0 2.04\nv 7 7 "
    "7\n";
constexpr char kSecond[] =
    "v 0 0 0\nv 1 -.1 0\nv 0 0 1.02\nv 1 -.1 1\nv 0 -.1 2\nv 1 0 2.04\nv 7 7 7\n";

class SceneFromTargetTest : public ::testing::Test {
 protected:
  SceneFromTargetTest() {
    WriteFile(dir_.File("a_1.obj"), std::string(kFirst) + kFaces);
    WriteFile(dir_.File("a_2.obj"), std::string(kSecond) + kFaces);
    target_.capture.rate = 50.0;
    target_.rest_shape = "uv";
  }
  Scene Make() const { return SceneFromTarget(dir_.path(), target_, options_); }
  std::string Error() const {
    return ErrorOf([&] { Make(); });
  }

  const TempDir dir_;
  TargetOptions target_;
  SceneFromTargetOptions options_;
};

TEST_F(SceneFromTargetTest, StartsInTheFirstFrameWithTheRestOfItsTexture) {
  options_.material.density = 0.3;
  const Scene scene = Make();
  ASSERT_EQ(scene.objects.size(), 1u);
  const ClothObject& cloth = scene.objects[0];
  ASSERT_EQ(cloth.num_vertices(), 6);
  EXPECT_EQ(cloth.positions[3], 1.02);
  EXPECT_DOUBLE_EQ(cloth.mass.sum(), 0.3 * 2.0);  // 2 square metres at rest
  ASSERT_EQ(cloth.rest_length.size(), cloth.num_springs());
  EXPECT_EQ(cloth.springs[0], (std::array<int, 2>{0, 1}));
  EXPECT_DOUBLE_EQ(cloth.rest_length[0], 1.0);
  EXPECT_EQ(scene.delta, 0.02);
  EXPECT_EQ(scene.num_frames, 2);
  EXPECT_EQ(scene.wind.norm(), 0.0);
}

TEST_F(SceneFromTargetTest, WithoutARestShapeTheFirstFrameIsIt) {
  target_.rest_shape.clear();
  const Scene scene = Make();
  EXPECT_DOUBLE_EQ(RestLengths(scene.objects[0])[0], 1.02);
}

TEST_F(SceneFromTargetTest, PinsWhatNeverMovesUnlessToldOtherwise) {
  EXPECT_EQ(Make().objects[0].is_fixed, (std::vector<char>{1, 0, 1, 0, 0, 0}));
  options_.pins = {5};
  EXPECT_EQ(Make().objects[0].is_fixed, (std::vector<char>{0, 0, 0, 0, 0, 1}));
  options_.pins = {6};
  EXPECT_THAT(Error(), HasSubstr("6"));
  options_.without_pins = true;
  EXPECT_THAT(Make().objects[0].is_fixed, Each(0));
}

TEST_F(SceneFromTargetTest, UnitsAreThoseOfTheTarget) {
  target_.capture.scale = 0.001;
  target_.capture.up = UpAxis::kZ;
  target_.rest_shape = "uv:0.001";
  const Scene scene = Make();
  EXPECT_DOUBLE_EQ(scene.objects[0].positions[3 * 4 + 1], 0.00204);  // z became y
  EXPECT_DOUBLE_EQ(scene.objects[0].rest_length[0], 0.001);
}

TEST_F(SceneFromTargetTest, WhatItCannotKnowIsAskedFor) {
  target_.capture.rate = 0.0;
  EXPECT_THAT(Error(), AllOf(StartsWith(dir_.path()), HasSubstr("rate")));
  const std::string csv = dir_.File("points.csv");
  WriteFile(csv, "frame,vertex,x,y,z\n0,0,1,2,3\n1,0,1,2,3\n");
  target_.capture.rate = 50.0;
  target_.rest_shape.clear();
  EXPECT_THAT(ErrorOf([&] { SceneFromTarget(csv, target_, options_); }),
              AllOf(StartsWith(csv), HasSubstr("OBJ")));
}

}  // namespace
}  // namespace dpe::test
