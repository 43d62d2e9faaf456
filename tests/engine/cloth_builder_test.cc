#include "dpe/engine/cloth_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "dpe/engine/scene_io.h"

namespace dpe::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

using Triangle = std::array<int, 3>;
using Spring = std::array<int, 2>;

std::string ErrorOfBuilding(const TriangleMesh& mesh,
                            const ClothMaterial& material = {}) {
  try {
    BuildClothFromMesh(mesh, material);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

// Springs by stiffness rounded to 1e-9 N/m.
std::map<long, int> StiffnessHistogram(const ClothObject& cloth, bool bending) {
  std::map<long, int> histogram;
  for (int s = 0; s < cloth.num_springs(); ++s) {
    if ((cloth.spring_kind[s] == SpringKind::kBend) != bending) continue;
    ++histogram[std::lround(cloth.stiffness[s] * 1e9)];
  }
  return histogram;
}

TEST(MakeGrid, NumbersVerticesAndTrianglesByTheRule) {
  const TriangleMesh grid = MakeGrid(/*rows=*/2, /*cols=*/3, 4.0, GridPlane::kXZ);
  Eigen::VectorXd expected(18);
  expected << -2, 0, -2, 0, 0, -2, 2, 0, -2, -2, 0, 2, 0, 0, 2, 2, 0, 2;
  EXPECT_EQ(grid.positions, expected);
  EXPECT_THAT(grid.triangles, ElementsAre(Triangle{0, 3, 4}, Triangle{0, 4, 1},
                                          Triangle{1, 4, 5}, Triangle{1, 5, 2}));
  const TriangleMesh standing = MakeGrid(2, 3, 4.0, GridPlane::kYZ);
  EXPECT_EQ(standing.positions.segment<3>(6), Eigen::Vector3d(0.0, 2.0, -2.0));
  EXPECT_EQ(standing.triangles, grid.triangles);
}

TEST(MakeGrid, VisitsColumnsBeforeRows) {
  const TriangleMesh grid = MakeGrid(3, 3, 1.0, GridPlane::kXZ);
  EXPECT_EQ(grid.triangles[2], (Triangle{3, 6, 7}));
}

TEST(MakeGrid, RefusesGridsThatAreNone) {
  EXPECT_THROW(MakeGrid(1, 5, 1.0, GridPlane::kXZ), SceneError);
  EXPECT_THROW(MakeGrid(5, 1, 1.0, GridPlane::kXZ), SceneError);
  EXPECT_THROW(MakeGrid(100000, 100000, 1.0, GridPlane::kXZ), SceneError);
  EXPECT_THROW(MakeGrid(5, 5, 0.0, GridPlane::kXZ), SceneError);
  EXPECT_THROW(MakeGrid(5, 5, std::nan(""), GridPlane::kXZ), SceneError);
}

TEST(BuildCloth, AppendsSpringsInTheOrderOfTheRule) {
  // By hand: triangle 0 12 13, then 0 13 1, then 12 24 25 below it.
  const Scene scene = MakePresetScene(ScenePreset::kSide);
  const ClothObject& cloth = scene.objects[0];
  const std::vector<Spring> first(cloth.springs.begin(), cloth.springs.begin() + 9);
  EXPECT_THAT(first, ElementsAre(Spring{0, 12}, Spring{0, 13}, Spring{12, 13},
                                 Spring{1, 12}, Spring{0, 1}, Spring{1, 13},
                                 Spring{12, 24}, Spring{12, 25}, Spring{24, 25}));
  using Kind = SpringKind;
  const std::vector<Kind> kinds(cloth.spring_kind.begin(),
                                cloth.spring_kind.begin() + 6);
  EXPECT_THAT(kinds, ElementsAre(Kind::kStretch, Kind::kShear, Kind::kStretch,
                                 Kind::kBend, Kind::kStretch, Kind::kStretch));
}

TEST(BuildCloth, AGridOf12By12HasTheKnownCountsAndStiffnesses) {
  const Scene scene = MakePresetScene(ScenePreset::kSide);
  const ClothObject& cloth = scene.objects[0];
  EXPECT_EQ(cloth.num_vertices(), 144);
  EXPECT_EQ(cloth.triangles.size(), 242);
  EXPECT_EQ(cloth.num_springs(), 385 + 341);
  // 44 edges on the boundary, 121 diagonals; 220 edges inside. Bending: 121 across the
  // diagonals, 220 across inner edges.
  EXPECT_THAT(StiffnessHistogram(cloth, false),
              ElementsAre(std::make_pair(25'000'000'000, 44 + 121),
                          std::make_pair(50'000'000'000, 220)));
  EXPECT_THAT(StiffnessHistogram(cloth, true),
              ElementsAre(std::make_pair(2'500'000'000, 220),
                          std::make_pair(6'250'000'000, 121)));
  EXPECT_NEAR(cloth.mass.sum(), 4.9, 1e-12);
  EXPECT_EQ(std::count(cloth.spring_kind.begin(), cloth.spring_kind.end(),
                       SpringKind::kShear),
            121);
}

TEST(BuildCloth, MassIsAThirdOfTheTrianglesAround) {
  TriangleMesh mesh;
  mesh.positions.resize(12);
  mesh.positions << 0, 0, 0, 3, 0, 0, 0, 2, 0, 0, 0, 4;
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}};  // areas 3 and 6
  ClothMaterial material;
  material.density = 2.0;
  const ClothObject cloth = BuildClothFromMesh(mesh, material);
  EXPECT_TRUE(cloth.mass.isApprox(Eigen::Vector4d(6.0, 6.0, 2.0, 4.0), 1e-14));
  // Springs 0-1 (vol 9), 0-2, 1-2, then 2-3 by bending (vol 12), 0-3, 1-3.
  ASSERT_EQ(cloth.springs[3], (Spring{2, 3}));
  EXPECT_NEAR(cloth.stiffness[0], 50.0 * 9.0 / 9.0, 1e-12);
  EXPECT_NEAR(cloth.stiffness[3], 12.5 * 12.0 / 20.0, 1e-12);
}

TEST(BuildCloth, EachKindOfSpringHasItsOwnStiffness) {
  const TriangleMesh grid = MakeGrid(4, 4, 3.0, GridPlane::kXZ);
  ClothMaterial base, scaled;
  base.shear_stiffness = 50.0;
  scaled.traction_stiffness = 2.0 * base.traction_stiffness;
  scaled.shear_stiffness = 3.0 * base.shear_stiffness;
  scaled.bending_stiffness = 5.0 * base.bending_stiffness;
  const ClothObject a = BuildClothFromMesh(grid, base);
  const ClothObject b = BuildClothFromMesh(grid, scaled);
  for (int s = 0; s < a.num_springs(); ++s) {
    const double factor = a.spring_kind[s] == SpringKind::kStretch ? 2.0
                          : a.spring_kind[s] == SpringKind::kShear ? 3.0
                                                                   : 5.0;
    EXPECT_NEAR(b.stiffness[s], factor * a.stiffness[s], 1e-10) << s;
  }
  EXPECT_EQ(BuildClothFromMesh(grid, {}).stiffness, a.stiffness);
}

TEST(BuildCloth, RefusesMeshesThatAreNoCloth) {
  TriangleMesh mesh = MakeGrid(2, 2, 1.0, GridPlane::kXZ);
  mesh.triangles[1][2] = 4;
  EXPECT_THAT(ErrorOfBuilding(mesh),
              AllOf(HasSubstr("triangle 1"), HasSubstr("0 to 3")));
  mesh.triangles[1] = {0, 1, 1};
  EXPECT_THAT(ErrorOfBuilding(mesh), HasSubstr("triangle 1 (vertices 0, 1, 1) has no"));
  mesh.triangles.resize(1);
  EXPECT_THAT(ErrorOfBuilding(mesh), HasSubstr("vertex 1 belongs to no triangle"));
  mesh.triangles.clear();
  EXPECT_THAT(ErrorOfBuilding(mesh), HasSubstr("no triangles"));

  TriangleMesh folded = MakeGrid(2, 2, 1.0, GridPlane::kXZ);
  folded.triangles = {{0, 2, 3}, {0, 3, 1}};
  folded.positions.segment<3>(3) = folded.positions.segment<3>(6);
  EXPECT_THAT(ErrorOfBuilding(folded), HasSubstr("coincide"));
}

TEST(BuildCloth, RefusesMaterialsThatAreNone) {
  const TriangleMesh grid = MakeGrid(2, 2, 1.0, GridPlane::kXZ);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (double wrong : {-1.0, nan, std::numeric_limits<double>::infinity()}) {
    for (double ClothMaterial::*field :
         {&ClothMaterial::traction_stiffness, &ClothMaterial::bending_stiffness,
          &ClothMaterial::density, &ClothMaterial::damping,
          &ClothMaterial::drag_coefficient}) {
      ClothMaterial material;
      material.*field = wrong;
      EXPECT_NE(ErrorOfBuilding(grid, material), "") << wrong;
    }
  }
  ClothMaterial material;
  material.density = 0.0;
  EXPECT_THAT(ErrorOfBuilding(grid, material), HasSubstr("density 0.0"));
  material = {};
  material.shear_stiffness = nan;
  EXPECT_THAT(ErrorOfBuilding(grid, material), HasSubstr("shear stiffness nan"));
}

TEST(Pins, FixTheVerticesOfBoxesAndLists) {
  ClothObject cloth = BuildClothFromMesh(MakeGrid(3, 4, 3.0, GridPlane::kXZ), {});
  EXPECT_EQ(PinBox({-1.5, -1.0, -1.5}, {-0.5, 1.0, -1.5}, &cloth), 2);
  EXPECT_EQ(PinBox({5.0, 5.0, 5.0}, {6.0, 6.0, 6.0}, &cloth), 0);
  PinVertices({11}, &cloth);
  EXPECT_THAT(cloth.is_fixed, ElementsAre(1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1));
  EXPECT_THROW(PinVertices({12}, &cloth), SceneError);
  EXPECT_THROW(PinVertices({-1}, &cloth), SceneError);
  UnpinAll(&cloth);
  EXPECT_THAT(cloth.is_fixed, ::testing::Each(0));
}

TEST(SmoothRandomField, HasTheSpreadAskedForAndVariesSlowly) {
  const TriangleMesh grid = MakeGrid(40, 40, 7.0, GridPlane::kXZ);
  const Eigen::Map<const Eigen::Matrix3Xd> points(grid.positions.data(), 3, 1600);
  const Eigen::ArrayXd z = SmoothRandomField(points, 0.3, 3.5, 5).array().log();
  EXPECT_NEAR(z.mean(), 0.0, 1e-12);
  EXPECT_NEAR(std::sqrt((z - z.mean()).square().mean()), 0.3, 1e-12);
  // Neighbours are 0.18 m apart, a twentieth of the shortest wave.
  double largest_step = 0.0;
  for (int v = 0; v + 1 < 1600; ++v) {
    if (v % 40 != 39) largest_step = std::max(largest_step, std::abs(z[v + 1] - z[v]));
  }
  EXPECT_LT(largest_step, 0.3);
  EXPECT_GT(largest_step, 0.01);
}

TEST(SmoothRandomField, DependsOnTheSeedOnly) {
  const Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Identity(3, 3);
  const Eigen::VectorXd a = SmoothRandomField(points, 1.0, 2.0, 1);
  EXPECT_EQ(a, SmoothRandomField(points, 1.0, 2.0, 1));
  EXPECT_NE(a, SmoothRandomField(points, 1.0, 2.0, 2));
  EXPECT_EQ(SmoothRandomField(points, 0.0, 2.0, 1), Eigen::VectorXd::Ones(3));
  EXPECT_THROW(SmoothRandomField(points, -1.0, 2.0, 1), SceneError);
  EXPECT_THROW(SmoothRandomField(points, 1.0, 0.0, 1), SceneError);
}

TEST(VaryMaterial, ScalesStiffnessAndMassByDifferentFields) {
  const ClothObject plain = BuildClothFromMesh(MakeGrid(6, 6, 7.0, GridPlane::kXZ), {});
  ClothObject varied = plain;
  VaryMaterial({0.5, 0.0, 3.5, 1}, &varied);
  EXPECT_EQ(varied.mass, plain.mass);
  EXPECT_GT((varied.stiffness - plain.stiffness).cwiseAbs().maxCoeff(), 1.0);
  VaryMaterial({0.0, 0.5, 3.5, 1}, &varied);
  EXPECT_GT((varied.mass - plain.mass).cwiseAbs().maxCoeff(), 0.01);
  EXPECT_GT(varied.mass.minCoeff(), 0.0);
}

TEST(Presets, PinMoveAndBlowAsTheirNamesSay) {
  std::vector<int> last_row(12), fixed;
  std::iota(last_row.begin(), last_row.end(), 132);
  for (const char* name : {"side", "corners", "flag", "flag_no_wind"}) {
    const bool is_flag = std::string(name).rfind("flag", 0) == 0;
    const Scene scene = MakePresetScene(ScenePresetFromName(name));
    EXPECT_NO_THROW(ValidateScene(scene, name));
    EXPECT_EQ(scene.title, name);
    EXPECT_EQ(scene.delta, 0.02);
    EXPECT_EQ(scene.tolerance, 1e-5);
    EXPECT_EQ(scene.steps_per_frame, 1);
    EXPECT_EQ(scene.integration_method, IntegrationMethod::kLinearlyImplicitEuler);
    EXPECT_EQ(scene.num_frames, is_flag ? 20 : 100);
    const ClothObject& cloth = scene.objects[0];
    EXPECT_EQ(cloth.damping, 0.1);
    EXPECT_EQ(cloth.drag_coefficient, 0.1);
    EXPECT_EQ(SettingsString(scene), "nL");
    EXPECT_EQ(cloth.positions.segment<3>(0), is_flag
                                                 ? Eigen::Vector3d(0.0, -3.5, -3.5)
                                                 : Eigen::Vector3d(-3.5, 0.0, -3.5));
    fixed.clear();
    for (int v = 0; v < 144; ++v) {
      if (cloth.is_fixed[v]) fixed.push_back(v);
    }
    if (std::string(name) == "corners") {
      EXPECT_THAT(fixed, ElementsAre(0, 11, 132, 143));
    } else {
      EXPECT_EQ(fixed, last_row);
    }
    const Eigen::Vector3d strong(106.066, 0.0, -106.066);
    EXPECT_EQ(scene.wind,
              std::string(name) == "flag" ? strong : Eigen::Vector3d(0.0, 0.0, 0.0));
  }
  EXPECT_THROW(ScenePresetFromName("sides"), SceneError);
}

}  // namespace
}  // namespace dpe::test
