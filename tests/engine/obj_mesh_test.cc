#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dpe/engine/cloth_builder.h"
#include "support/temp_dir.h"

namespace dpe::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

using Triangle = std::array<int, 3>;

TriangleMesh Load(const std::string& text) {
  const TempDir folder;
  WriteFile(folder.File("mesh.obj"), text);
  return LoadObjMesh(folder.File("mesh.obj"));
}

std::string ErrorOfLoading(const std::string& text) {
  try {
    Load(text);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

constexpr char kSquare[] =
    "# a square\n"
    "mtllib absent.mtl\n"
    "v 0.1 0 0\nv 1 0 0 0.5 0.5 0.5\nv 1 1e-1 0\r\nv 0 1 0\n"
    "vt 0 0\nvn 0 0 1\n";

TEST(ObjMesh, ReadsPositionsExactlyAndSplitsFaces) {
  const TriangleMesh mesh =
      Load(std::string(kSquare) + "f 1 2 3\nf 1/1/1 3/1/1 4/1/1\n");
  EXPECT_EQ(mesh.positions.size(), 12);
  EXPECT_EQ(mesh.positions[0], 0.1);
  EXPECT_EQ(mesh.positions[7], 0.1);
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
  EXPECT_EQ(Load(std::string(kSquare) + "f 1 2 3 4\n").triangles.size(), 2);
  // Normals and textures do not matter, so neither do their indices.
  EXPECT_EQ(Load(std::string(kSquare) + "f 1/9/9 2/9/9 3/9/9\n").triangles.size(), 1);
  EXPECT_THAT(Load(std::string(kSquare) + "f -4 -3 -2\n").triangles,
              ElementsAre(Triangle{0, 1, 2}));
}

TEST(ObjMesh, LeavesOutVerticesWithoutAFace) {
  const TriangleMesh mesh = Load(std::string(kSquare) + "f 1 3 4\n");
  EXPECT_EQ(mesh.positions.size(), 9);
  EXPECT_EQ(mesh.positions.segment<3>(3), Eigen::Vector3d(1.0, 0.1, 0.0));
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
}

TEST(ObjMesh, AGridFromAFileIsTheSameCloth) {
  const TriangleMesh grid = MakeGrid(4, 5, 7.0, GridPlane::kYZ);
  std::ostringstream text;
  text.precision(17);
  for (int v = 0; v < 20; ++v) {
    text << "v " << grid.positions.segment<3>(3 * v).transpose() << "\n";
  }
  for (const Triangle& t : grid.triangles) {
    text << "f " << t[0] + 1 << " " << t[1] + 1 << " " << t[2] + 1 << "\n";
  }
  const TriangleMesh read = Load(text.str());
  EXPECT_EQ(read.positions, grid.positions);
  EXPECT_EQ(read.triangles, grid.triangles);
}

// What a cloth does not need cannot make its file wrong, be it nonsense or not.
TEST(ObjMesh, OtherKindsOfLinesAreNotRead) {
  const TriangleMesh mesh = Load(std::string(kSquare) +
                                 "vw 1 0 7e26\nvw 1 0 7777777777777777777777\n"
                                 "usemtl \ng a b\ns 99999999999\nvp x\n"
                                 "l 1 900\np 77\nt 1 2 3\n\tf 1 3 4\n");
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
}

TEST(ObjMesh, LinesEndAsOnAnySystem) {
  for (const char* end : {"\n", "\r\n", "\r"}) {
    std::string text = "# mesh\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
    for (size_t at = 0; (at = text.find('\n', at)) != std::string::npos;) {
      text.replace(at, 1, end);
      at += std::string(end).size();
    }
    EXPECT_THAT(Load(text).triangles, ElementsAre(Triangle{0, 1, 2}));
    EXPECT_THAT(ErrorOfLoading(text + "v 0 0" + end), HasSubstr("line 6"));
  }
}

TEST(ObjMesh, RefusesFilesThatAreNoMesh) {
  EXPECT_THAT(ErrorOfLoading(""), HasSubstr("no faces"));
  EXPECT_THAT(ErrorOfLoading(kSquare), HasSubstr("no faces"));
  EXPECT_THAT(ErrorOfLoading("v 0 0 0\nv 1 zero 0\nv 1 1 0\nf 1 2 3\n"),
              AllOf(HasSubstr("line 2"), HasSubstr("v 1 zero 0"),
                    HasSubstr("three finite numbers")));
  EXPECT_THAT(ErrorOfLoading("v 0 0\n"), HasSubstr("line 1"));
  EXPECT_THAT(ErrorOfLoading("v 0 0 nan\n"), HasSubstr("line 1"));
  EXPECT_THAT(ErrorOfLoading(std::string(kSquare) + "f 1 2 5\n"),
              HasSubstr("mesh.obj"));
  EXPECT_THAT(ErrorOfLoading(std::string(kSquare) + "f 1 2 3 9\n"),
              HasSubstr("mesh.obj"));
  EXPECT_THAT(ErrorOfLoading(std::string(kSquare) + "f 1 2 0\n"),
              HasSubstr("mesh.obj"));
  EXPECT_THAT(ErrorOfLoading(std::string(kSquare) + "f 1 2 3\nf 1 2\n"),
              HasSubstr("egenerated"));
  // Found by fuzzing: of this face one triangle was made, and nothing said.
  EXPECT_THAT(ErrorOfLoading(std::string(kSquare) + kSquare + "f 2 3 1 6 3 1 6\n"),
              AllOf(HasSubstr("mesh.obj"), HasSubstr("5 triangles, of which")));
  const TempDir folder;
  EXPECT_THROW(LoadObjMesh(folder.path()), SceneError);
  try {
    LoadObjMesh(folder.File("absent.obj"));
    FAIL() << "a file that does not exist was accepted";
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(), AllOf(StartsWith(folder.File("absent.obj")),
                                    HasSubstr("expected an OBJ file")));
  }
}

}  // namespace
}  // namespace dpe::test
