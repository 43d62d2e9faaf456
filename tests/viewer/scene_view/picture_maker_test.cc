#include "scene_view/picture_maker.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <thread>
#include <utility>

#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/simulator.h"
#include "scene_view/collider_shapes.h"
#include "scene_view/guides.h"
#include "support/test_scenes.h"

namespace dpe::viewer {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

ViewOptions ClothAlone() {
  ViewOptions view;
  view.ground = view.axes = view.wind = view.colliders = false;
  return view;
}

TEST(NormalsTest, PointToTheSideFromWhichTheTriangleIsCounterClockwise) {
  const std::vector<glm::vec3> points = {{0, 0, 0}, {0, 0, 2}, {2, 0, 0}, {5, 5, 5}};
  const std::vector<glm::vec3> up = VertexNormals(points, {0, 1, 2});
  EXPECT_EQ(up[0], glm::vec3(0, 1, 0));
  EXPECT_EQ(VertexNormals(points, {0, 2, 1})[0], glm::vec3(0, -1, 0));
  EXPECT_EQ(up[3], glm::vec3(0, 1, 0));  // of no triangle
  // By area: the larger triangle counts more.
  const std::vector<glm::vec3> corner = {
      {0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 3, 0}, {0, 0, 3}};
  const glm::vec3 n = VertexNormals(corner, {0, 1, 2, 0, 3, 4})[0];
  EXPECT_NEAR(n.x / n.y, 9.0f, 1e-4f);
  EXPECT_NEAR(glm::length(n), 1.0f, 1e-6f);
}

TEST(ClothShapeTest, LeavesOutWhatIsNotKnown) {
  const Scene scene = test::MakeDerivativeScene("side", 3);
  const ClothShape shape(scene.objects[0]);
  EXPECT_EQ(shape.edges().size(), 16);  // of a 3 x 3 grid with diagonals
  Eigen::VectorXd x = scene.objects[0].positions;
  const std::vector<glm::vec4> colors(9, glm::vec4(1.0f));
  const Surface whole = shape.MakeSurface(x, colors);
  EXPECT_EQ(whole.topology->triangles.size(), 3 * 8);
  EXPECT_EQ(whole.topology, shape.MakeSurface(x, colors).topology);  // is shared
  x.segment<3>(3 * 4).setConstant(kNaN);  // the middle: all but two corners' triangles
  const Surface holed = shape.MakeSurface(x, colors);
  EXPECT_EQ(holed.topology->triangles.size(), 3 * 2);
  for (const glm::vec3& p : holed.positions) EXPECT_TRUE(std::isfinite(p.x));
  const Lines lines = ClothShape::MakeLines(x, shape.edges(), {glm::vec4(1.0f)});
  EXPECT_EQ(lines.positions.size(), 2 * (16 - 6));
  EXPECT_EQ(lines.colors.size(), lines.positions.size());
}

TEST(PictureMakerTest, ShowsTheSceneAsASurfaceWithItsPins) {
  PlayerSources sources;
  sources.scene = test::MakeDerivativeScene("side", 4);
  Player player(std::move(sources));
  PictureMaker maker(player.scene(), nullptr, {});
  const Picture picture = maker.Make(player, ClothAlone());
  ASSERT_EQ(picture.surfaces.size(), 1);
  EXPECT_EQ(picture.surfaces[0].positions.size(), 16);
  EXPECT_EQ(picture.surfaces[0].normals.size(), 16);
  EXPECT_EQ(picture.surfaces[0].colors.size(), 16);
  ASSERT_EQ(picture.points.size(), 1);
  EXPECT_EQ(picture.points[0].positions.size(), 4);  // the last row
  EXPECT_FALSE(maker.scale());
  EXPECT_GT(picture.surfaces[0].edge_width, 0.0f);
  EXPECT_EQ(picture.surfaces[0].topology->corners.size(), 16);
  ASSERT_EQ(picture.lines.size(), 1);
  EXPECT_EQ(picture.lines[0].positions.size(), 2 * 12);  // the border alone
  EXPECT_FALSE(picture.surfaces[0].under_lines);
  ViewOptions springs = ClothAlone();
  springs.springs = true;
  EXPECT_TRUE(maker.Make(player, springs).surfaces[0].under_lines);
  ViewOptions edges = ClothAlone();
  edges.surface = false;  // then they are lines
  EXPECT_TRUE(maker.Make(player, edges).surfaces.empty());
  ASSERT_EQ(maker.Make(player, edges).lines.size(), 1);
  EXPECT_EQ(maker.Make(player, edges).lines[0].positions.size(), 2 * 33);
  ViewOptions plain = ClothAlone();
  plain.wireframe = false;
  EXPECT_EQ(maker.Make(player, plain).surfaces[0].edge_width, 0.0f);
  ViewOptions nothing = ClothAlone();
  nothing.surface = nothing.wireframe = nothing.fixed_vertices = false;
  EXPECT_TRUE(maker.Make(player, nothing).surfaces.empty());
  EXPECT_TRUE(maker.Make(player, nothing).lines.empty());
}

// The ground's lines are drawn along a plane.
TEST(PictureMakerTest, CollidersAreUnderLines) {
  PlayerSources sources;
  sources.scene = test::MakeDerivativeScene("side", 4);
  Collider plane;
  plane.type = ColliderType::kPlane;
  plane.position = {0.0, -3.0, 0.0};
  sources.scene.colliders = {plane};
  Player player(std::move(sources));
  PictureMaker maker(player.scene(), nullptr, {});
  const Picture picture = maker.Make(player, ViewOptions());
  ASSERT_EQ(picture.surfaces.size(), 2);
  EXPECT_TRUE(picture.surfaces[0].under_lines);
  EXPECT_FALSE(picture.surfaces[1].under_lines);
}

TEST(PictureMakerTest, ShowsTheEstimateAsAGreenWireframeOverTheTarget) {
  const Scene scene = test::MakeDerivativeScene("side", 4);
  Scene stiffer = scene;
  stiffer.objects[0].stiffness *= 5.0;
  PlayerSources sources;
  sources.scene = scene;
  sources.trajectory =
      RecordedMotion(ObserveAll(Simulator(scene).Simulate(6)), scene.delta);
  const Trajectory target = Simulator(stiffer).Simulate(6);
  sources.target = RecordedMotion(ObserveAll(target), scene.delta);
  Player player(std::move(sources));
  player.Seek(5);
  PictureMaker maker(player.scene(), nullptr, {});
  ViewOptions view = ClothAlone();
  view.color = ColorMode::kDistance;
  const Picture picture = maker.Make(player, view);
  ASSERT_EQ(picture.surfaces.size(), 1);
  EXPECT_TRUE(picture.surfaces[0].under_lines);
  const Eigen::VectorXd seen = target.positions[0].col(5);
  EXPECT_EQ(picture.surfaces[0].positions[3], ToPoint(seen.segment<3>(9)));
  ASSERT_EQ(picture.lines.size(), 2);  // the target's border, and the estimate
  const Lines& estimate = picture.lines[1];
  EXPECT_GT(estimate.colors[0].y, 3.0f * estimate.colors[0].x);
  const Eigen::VectorXd& x = player.motion().positions[0];
  EXPECT_EQ(estimate.positions[0], ToPoint(x.segment<3>(0)));
  // The scale is of the distance, and reaches the largest.
  ASSERT_TRUE(maker.scale());
  double largest = 0.0;
  for (Eigen::Index c = 0; c < x.size(); c += 3) {
    largest = std::max(largest, (x - seen).segment<3>(c).norm());
  }
  EXPECT_EQ(maker.scale()->high, RoundUp(largest));
  EXPECT_EQ(maker.scale()->unit, "m");
  EXPECT_EQ(picture.surfaces[0].colors[0],
            maker.scale()->Color((x - seen).segment<3>(0).norm()));
  // It does not shrink again while things move.
  player.Seek(1);
  maker.Make(player, view);
  EXPECT_EQ(maker.scale()->high, RoundUp(largest));
}

TEST(PictureMakerTest, TurnedParametersAreSeenInTheColours) {
  PlayerSources sources;
  sources.scene = test::MakeDerivativeScene("side", 4);
  Player player(std::move(sources));
  PictureMaker maker(player.scene(), nullptr, {});
  ViewOptions view = ClothAlone();
  view.color = ColorMode::kStiffness;
  maker.Make(player, view);
  const double before = maker.scale()->high;
  Tuning tuning = player.tuning();
  tuning.objects[0].stiffness_factor = 3.0;
  player.SetTuning(tuning);
  maker.Make(player, view);
  EXPECT_NEAR(maker.scale()->high, 3.0 * before, 1e-9);
  EXPECT_EQ(maker.scale()->unit, "N/m");
}

TEST(GuidesTest, TheWindArrowPointsWithTheWind) {
  const Ball ball{{0, 0, 0}, 1.0f};
  EXPECT_TRUE(WindArrow(ball, 0.0, Eigen::Vector3d::Zero()).positions.empty());
  const Lines arrow = WindArrow(ball, 0.0, {0.0, 0.0, -7.0});
  const glm::vec3 shaft = arrow.positions[1] - arrow.positions[0];
  EXPECT_LT(shaft.z, -0.1f);
  EXPECT_NEAR(shaft.x, 0.0f, 1e-6f);
  const Lines weak = WindArrow(ball, 0.0, {0.0, 0.0, -1.0});
  EXPECT_LT(glm::length(weak.positions[1] - weak.positions[0]), glm::length(shaft));
}

TEST(GuidesTest, AxesAreRightHandedAndTheGroundIsLevel) {
  const Ball ball{{0, 0, 0}, 4.0f};
  const Lines axes = Axes(ball, -2.0);
  const glm::vec3 x = axes.positions[1] - axes.positions[0];
  const glm::vec3 y = axes.positions[3] - axes.positions[2];
  const glm::vec3 z = axes.positions[5] - axes.positions[4];
  EXPECT_GT(x.x, 0.0f);
  EXPECT_GT(y.y, 0.0f);
  EXPECT_GT(glm::dot(glm::cross(x, y), z), 0.0f);
  EXPECT_GT(axes.colors[0].x, axes.colors[0].z);  // x is red
  EXPECT_GT(axes.colors[4].z, axes.colors[4].x);  // z is blue
  EXPECT_EQ(GridSpacing(ball), 1.0);
  for (const glm::vec3& p : GroundGrid(ball, -2.0, glm::vec4(0.0f)).positions)
    EXPECT_EQ(p.y, -2.0f);
}

TEST(ColliderShapesTest, AreWhereTheForcesAre) {
  const Surface sphere = ColliderSurface(SphereCollider({1, 2, 3}, 0.5), {});
  for (size_t i = 0; i < sphere.positions.size(); ++i) {
    const glm::vec3 d = sphere.positions[i] - glm::vec3(1, 2, 3);
    EXPECT_NEAR(glm::length(d), 0.5f, 1e-5f);
    EXPECT_GT(glm::dot(d, sphere.normals[i]), 0.49f);
  }
  const std::vector<std::uint32_t>& t = sphere.topology->triangles;
  for (size_t k = 300; k < 600; k += 3) {
    const glm::vec3 a = sphere.positions[t[k]], b = sphere.positions[t[k + 1]],
                    c = sphere.positions[t[k + 2]];
    EXPECT_GE(glm::dot(glm::cross(b - a, c - a), a - glm::vec3(1, 2, 3)), 0.0f);
  }
  Collider plane;
  plane.type = ColliderType::kPlane;
  plane.position = {0.0, -1.0, 0.0};
  plane.rotation_degrees = {0.0, 0.0, 90.0};  // +y turns to -x
  const Surface wall = ColliderSurface(plane, {{3.0f, 0.0f, 0.0f}, 1.0f});
  EXPECT_NEAR(wall.normals[0].x, -1.0f, 1e-6f);
  for (const glm::vec3& p : wall.positions) EXPECT_NEAR(p.x, 0.0f, 1e-6f);
}

}  // namespace
}  // namespace dpe::viewer
