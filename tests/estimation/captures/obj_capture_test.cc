#include <filesystem>

#include "dpe/engine/cloth_builder.h"
#include "estimation/captures/capture_support.h"

namespace dpe::test {
namespace {

class ObjCapture : public ::testing::Test {
 protected:
  // A square of two triangles at height y, with a loose vertex before it.
  static std::string Square(const std::string& y) {
    return "# made by hand\no cloth\nv 9 9 9\n"
           "v 0 " +
           y + " 0\nv 1 " + y + " 0\nv 1 " + y + " 1\nv 0 " + y +
           " 1\n"
           "vn 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
           "f 2/1/1 3/2/1 4/3/1\nf 2/1 4/3 5/4\n";
  }
  void Write(const std::string& name, const std::string& text) {
    WriteFile(dir_.File(name), text);
  }
  std::string ErrorOfFolder() {
    return ErrorOf([&] { ReadCapture(dir_.path()); });
  }

  const TempDir dir_;
};

TEST_F(ObjCapture, FramesAreInTheOrderOfTheirNumbers) {
  Write("cloth_v2_9.obj", Square("0.9"));
  Write("cloth_v2_10.obj", Square("1.0"));
  Write("cloth_v2_8.obj", Square("0.8"));
  Write("notes.txt", "no mesh");
  const Capture c = ReadCapture(dir_.path());
  EXPECT_EQ(c.format, "OBJ");
  EXPECT_EQ(c.num_vertices, 5);
  ASSERT_EQ(c.samples.size(), 15u);
  for (int f = 0; f < 3; ++f) {
    EXPECT_EQ(c.samples[5 * f + 4].time, 8 + f);
    EXPECT_EQ(c.samples[5 * f + 4].position, Eigen::Vector3d(0, 0.8 + 0.1 * f, 1));
  }
  EXPECT_EQ(ReadCapture(dir_.File("cloth_*.obj")).samples.size(), 15u);
  EXPECT_EQ(ReadCapture(dir_.File("cloth_v2_?.obj")).samples.size(), 10u);
}

TEST_F(ObjCapture, HasTheMeshOfItsFirstFile) {
  Write("a1.obj", Square("0"));
  const Capture c = ReadCapture(dir_.File("a1.obj"));
  using Triangle = std::array<int, 3>;
  EXPECT_THAT(c.mesh.triangles, ElementsAre(Triangle{1, 2, 3}, Triangle{1, 3, 4}));
  EXPECT_THAT(c.mesh.in_a_face, ElementsAre(0, 1, 1, 1, 1));
  ASSERT_EQ(c.mesh.texture_coordinates.cols(), 5);
  EXPECT_TRUE(c.mesh.texture_coordinates.col(0).hasNaN());
  EXPECT_EQ(c.mesh.texture_coordinates.col(3), Eigen::Vector2d(1, 1));
  EXPECT_EQ(c.mesh.texture_seam, "");
  std::string seam = Square("0");
  seam.replace(seam.rfind("4/3"), 3, "4/2");
  Write("a1.obj", seam);
  EXPECT_THAT(ReadCapture(dir_.path()).mesh.texture_seam,
              AllOf(StartsWith(dir_.File("a1.obj") + ":14: "), HasSubstr("vertex 3")));
}

TEST_F(ObjCapture, PolygonsAreSplitAsTheEngineSplitsThem) {
  Write("q1.obj", "v 0 0 0\nv 3 0 0\nv 2 0 2\nv 0 0 1\nf 1 2 3 4\nf -4//1 -3 -2\n");
  const Capture c = ReadCapture(dir_.path());
  EXPECT_EQ(c.mesh.triangles, LoadObjMesh(dir_.File("q1.obj")).triangles);
  EXPECT_EQ(c.mesh.triangles.size(), 3u);
  EXPECT_EQ(c.mesh.texture_coordinates.size(), 0);
}

TEST_F(ObjCapture, FilesThatAreNoSequenceAreRefused) {
  EXPECT_THAT(ErrorOfFolder(), AllOf(StartsWith(dir_.path()), HasSubstr(".obj")));
  EXPECT_THAT(ErrorOf([&] { ReadCapture(dir_.File("x_*.obj")); }),
              AllOf(HasSubstr("x_*.obj"), HasSubstr("no file")));
  Write("a1.obj", Square("0"));
  Write("b2.obj", Square("0"));
  EXPECT_THAT(ErrorOfFolder(), AllOf(HasSubstr("a1.obj"), HasSubstr("b2.obj"),
                                     HasSubstr("differ in one number")));
  std::filesystem::remove(dir_.File("b2.obj"));
  Write("a01.obj", Square("0"));
  EXPECT_THAT(ErrorOfFolder(), HasSubstr("are both frame 1"));
  std::filesystem::remove(dir_.File("a01.obj"));
  Write("a99999999999.obj", Square("0"));
  EXPECT_THAT(ErrorOfFolder(), HasSubstr("'99999999999'"));
  const TempDir two;
  for (const char* name : {"a1_1.obj", "a1_2.obj", "a2_1.obj"}) {
    WriteFile(two.File(name), Square("0"));
  }
  EXPECT_THAT(ErrorOf([&] { ReadCapture(two.path()); }),
              HasSubstr("differ in one number"));
}

TEST_F(ObjCapture, ChangesOfTopologyAreRefusedWithTheirLine) {
  Write("a1.obj", Square("0"));
  const std::string path = dir_.File("a2.obj");
  std::string changed = Square("1");
  changed.replace(changed.rfind("5/4"), 3, "3/2");
  Write("a2.obj", changed);
  EXPECT_THAT(ErrorOfFolder(), AllOf(StartsWith(path + ":14: "), HasSubstr("'f 2 4 3'"),
                                     HasSubstr("'f 2 4 5'"), HasSubstr("a1.obj:14")));
  Write("a2.obj", Square("1") + "f 3 4 5\n");
  EXPECT_THAT(ErrorOfFolder(),
              AllOf(StartsWith(path + ":15: "), HasSubstr("3 faces"), HasSubstr("2")));
  Write("a2.obj", Square("1") + "v 1 2 3\n");
  EXPECT_THAT(ErrorOfFolder(), AllOf(StartsWith(path + ":15: "),
                                     HasSubstr("6 vertices"), HasSubstr("are 5")));
  Write("a2.obj", "");
  EXPECT_THAT(ErrorOfFolder(), AllOf(StartsWith(path), HasSubstr("0 vertices")));
}

TEST_F(ObjCapture, BadLinesAreRefused) {
  const std::string path = dir_.File("a1.obj");
  const auto error = [&](const std::string& from, const std::string& to) {
    std::string text = Square("0");
    text.replace(text.find(from), from.size(), to);
    Write("a1.obj", text);
    return ErrorOfFolder();
  };
  EXPECT_THAT(error("v 0 0 0", "v 0 zero 0"),
              AllOf(StartsWith(path + ":4: "), HasSubstr("y is 'zero'")));
  EXPECT_THAT(error("v 0 0 0", "v 0 0"),
              AllOf(StartsWith(path + ":4: "), HasSubstr("2 numbers")));
  EXPECT_THAT(error("v 0 0 0", "v 0 0 nan"), HasSubstr("z is 'nan'"));
  EXPECT_THAT(error("vt 0 0", "vt 0 x"),
              AllOf(StartsWith(path + ":9: "), HasSubstr("v is 'x'")));
  EXPECT_THAT(error("5/4", "6/4"), AllOf(StartsWith(path + ":14: "),
                                         HasSubstr("vertex 6"), HasSubstr("1 to 5")));
  EXPECT_THAT(error("5/4", "5/5"),
              AllOf(StartsWith(path + ":14: "), HasSubstr("coordinate 5")));
  EXPECT_THAT(error("5/4", "0/4"), HasSubstr("'0/4'"));
  EXPECT_THAT(error("5/4", "x"), HasSubstr("'x'"));
  EXPECT_THAT(error("5/4", "-6"), HasSubstr("'-6'"));
  EXPECT_THAT(error("5/4", "5/-5"), HasSubstr("'5/-5'"));
  EXPECT_THAT(error(" 5/4", ""),
              AllOf(StartsWith(path + ":14: "), HasSubstr("2 corners")));
  Write("a1.obj", "o nothing\n");
  EXPECT_THAT(ErrorOfFolder(), HasSubstr("no vertices"));
}

}  // namespace
}  // namespace dpe::test
