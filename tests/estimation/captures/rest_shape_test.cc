#include "dpe/estimation/rest_shape.h"

#include "estimation/captures/capture_support.h"
#include "support/test_scenes.h"

namespace dpe::test {
namespace {

// A bent strip of two squares of side 2, folded up in the middle by a right angle; its
// texture is the flat strip, of height 1 and length 2.
constexpr char kStrip[] =
    "v 0 0 0\nv 2 0 0\nv 0 0 2\nv 2 0 2\nv 0 2 2\nv 2 2 2\nv 7 7 7\n"
    "vt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\nvt 0 2\nvt 1 2\n"
    "f 1/1 2/2 4/4\nf 1/1 4/4 3/3\nf 3/3 4/4 6/6\nf 3/3 6/6 5/5\n";

class RestShape : public ::testing::Test {
 protected:
  Capture Read(const std::string& text) {
    WriteFile(dir_.File("a1.obj"), text);
    return ReadCapture(dir_.path());
  }
  std::string ErrorOfTexture(const std::string& text,
                             const std::string& source = "uv") {
    const Capture capture = Read(text);
    return ErrorOf([&] { ReadRestShape(source, 0.0, capture); });
  }
  static std::string Edited(const std::string& from, const std::string& to) {
    std::string text = kStrip;
    return text.replace(text.rfind(from), from.size(), to);
  }
  static double Length(const Eigen::VectorXd& x, int a, int b) {
    return (x.segment<3>(3 * a) - x.segment<3>(3 * b)).norm();
  }

  const TempDir dir_;
};

TEST_F(RestShape, TheTextureIsTheFlatShape) {
  const Capture capture = Read(kStrip);
  const Eigen::VectorXd unit = ReadRestShape("uv", 0.001, capture);
  ASSERT_EQ(unit.size(), 18);  // without the loose vertex
  EXPECT_EQ(Length(unit, 0, 4), 2.0);
  EXPECT_EQ(Length(ReadRestShape("uv:2", 0.0, capture), 0, 4), 4.0);
  const Eigen::VectorXd both = ReadRestShape("uv:3,0.5", 0.0, capture);
  EXPECT_EQ(Length(both, 0, 1), 3.0);
  EXPECT_EQ(Length(both, 0, 4), 1.0);
}

TEST_F(RestShape, BadTexturesAreRefused) {
  const std::string path = dir_.File("a1.obj");
  EXPECT_THAT(ErrorOfTexture(Edited("3/3 6/6", "3/1 6/6")),
              AllOf(StartsWith(path + ":17: "), HasSubstr("vertex 2"),
                    HasSubstr("one per vertex")));
  EXPECT_THAT(ErrorOfTexture(Edited("5/5", "5")),
              AllOf(StartsWith(path), HasSubstr("vertex 4 has no texture")));
  EXPECT_THAT(ErrorOfTexture("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
              AllOf(StartsWith(dir_.path()), HasSubstr("no texture coordinates")));
  for (const char* source : {"uv:", "uv:0", "uv:-1", "uv:1,2,3", "uv:1,x", "uv:inf"}) {
    EXPECT_THAT(ErrorOfTexture(kStrip, source),
                AllOf(HasSubstr(source), HasSubstr("uv:SIZE")));
  }
}

TEST_F(RestShape, AnotherFileHasTheUnitsOfTheTarget) {
  const Capture capture = Read(kStrip);
  WriteFile(dir_.File("rest"), kStrip);
  EXPECT_EQ(Length(ReadRestShape(dir_.File("rest"), 0.01, capture), 0, 1), 0.02);
  EXPECT_EQ(Length(ReadRestShape(dir_.File("rest"), 0.0, capture), 0, 1), 2.0);
  EXPECT_THAT(ErrorOf([&] { ReadRestShape(dir_.File("no"), 0.0, capture); }),
              HasSubstr(dir_.File("no")));
}

TEST_F(RestShape, SetsTheRestLengthsOfTheClothOfItsSize) {
  Scene scene = MakeDerivativeScene("two_objects", 3);
  const ClothObject before = scene.objects[1];
  std::vector<std::string> warnings;
  SetRestShape(1.5 * before.positions, "rest.obj", -1, &scene, &warnings);
  EXPECT_TRUE(scene.objects[1].rest_length.isApprox(1.5 * RestLengths(before), 1e-12));
  EXPECT_EQ(scene.objects[0].rest_length.size(), 0);
  EXPECT_TRUE(warnings.empty());
  SetRestShape(1500.0 * before.positions, "rest.obj", 1, &scene, &warnings);
  EXPECT_THAT(warnings, ElementsAre(AllOf(StartsWith("rest.obj: "),
                                          HasSubstr("less than half"))));
}

TEST_F(RestShape, ShapesThatDoNotFitAreRefused) {
  Scene scene = MakeDerivativeScene("two_objects", 3);
  const Eigen::VectorXd rest = scene.objects[0].positions;
  const auto error = [&](const Eigen::VectorXd& shape, int object) {
    return ErrorOf([&] { SetRestShape(shape, "rest.obj", object, &scene); });
  };
  EXPECT_THAT(error(rest.head(24), -1),
              AllOf(StartsWith("rest.obj: has 8 vertices"), HasSubstr("9, 6")));
  EXPECT_THAT(error(rest, 1), HasSubstr("object 1"));
  EXPECT_THAT(error(Eigen::VectorXd::Zero(27), -1),
              AllOf(StartsWith("rest.obj: vertices"), HasSubstr("coincide")));
  scene.objects.push_back(scene.objects[0]);
  EXPECT_THAT(error(rest, -1), HasSubstr("several"));
  EXPECT_EQ(error(rest, 2), "accepted");
}

TEST_F(RestShape, AClothFromACaptureIsThatOfItsRestShape) {
  const Capture capture = Read(kStrip);
  ClothMaterial material;
  material.density = 1.0;
  // Flat, 2 m x 2 m in the texture's units of 1 m: half as wide as the mesh.
  const Eigen::VectorXd rest = ReadRestShape("uv", 0.0, capture);
  const ClothObject cloth = BuildClothFromCapture(capture, rest, material);
  EXPECT_EQ(cloth.num_vertices(), 6);
  EXPECT_EQ(cloth.positions.segment<3>(12), Eigen::Vector3d(0, 2, 2));
  EXPECT_NEAR(cloth.mass.sum(), 2.0, 1e-12);
  TriangleMesh flat;
  flat.positions = rest;
  flat.triangles = capture.mesh.triangles;
  const ClothObject at_rest = BuildClothFromMesh(flat, material);
  EXPECT_EQ(cloth.stiffness, at_rest.stiffness);
  EXPECT_EQ(cloth.rest_length, RestLengths(at_rest));
  // Without a rest shape the first frame is at rest.
  const ClothObject bent = BuildClothFromCapture(capture, {}, material);
  EXPECT_NEAR(bent.mass.sum(), 8.0, 1e-12);
  EXPECT_EQ(bent.rest_length.size(), 0);
  EXPECT_THAT(ErrorOf([&] { BuildClothFromCapture(capture, rest.head(9), material); }),
              AllOf(HasSubstr("6 vertices"), HasSubstr("rest shape 3")));
  EXPECT_THAT(ErrorOf([&] { BuildClothFromCapture(Capture(), {}, material); }),
              HasSubstr("no triangles"));
}

}  // namespace
}  // namespace dpe::test
