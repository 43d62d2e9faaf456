#include "scene_view/corner_coloring.h"

#include <gtest/gtest.h>

#include <set>

#include "dpe/engine/cloth_builder.h"
#include "scene_view/cloth_picture.h"
#include "support/test_scenes.h"

namespace dpe::viewer {
namespace {

using Triangles = std::vector<std::array<int, 3>>;

// Five triangles around vertex 0, which three numbers cannot go around, and one apart.
Triangles OddFan() {
  return {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1}, {7, 8, 9}};
}

// The vertices that were given, and all three numbers in each triangle.
void ExpectRight(const CornerColoring& coloring, const Triangles& triangles, int n) {
  ASSERT_EQ(coloring.triangles.size(), triangles.size());
  ASSERT_EQ(coloring.corners.size(), n + coloring.copies.size());
  for (size_t t = 0; t < triangles.size(); ++t) {
    std::set<std::uint32_t> corners;
    for (int k = 0; k < 3; ++k) {
      const auto vertex = static_cast<int>(coloring.triangles[t][k]);
      ASSERT_LT(vertex, coloring.corners.size());
      corners.insert(coloring.corners[vertex]);
      EXPECT_EQ(vertex < n ? vertex : coloring.copies[vertex - n], triangles[t][k]);
    }
    EXPECT_EQ(corners, (std::set<std::uint32_t>{0, 1, 2})) << "triangle " << t;
  }
}

TEST(CornerColoringTest, AGridNeedsNoCopies) {
  PresetOptions options;
  options.rows = 7;
  options.cols = 5;
  for (const ScenePreset preset : {ScenePreset::kSide, ScenePreset::kFlag}) {
    const ClothObject object = MakePresetScene(preset, options).objects[0];
    const CornerColoring coloring =
        ColorCorners(object.triangles, object.num_vertices());
    ExpectRight(coloring, object.triangles, object.num_vertices());
    EXPECT_TRUE(coloring.copies.empty());
  }
}

TEST(CornerColoringTest, WhatDoesNotComeOutGetsCopies) {
  const CornerColoring coloring = ColorCorners(OddFan(), 10);
  ExpectRight(coloring, OddFan(), 10);
  EXPECT_GE(coloring.copies.size(), 1);
  EXPECT_LE(coloring.copies.size(), 2);
  EXPECT_LE(coloring.corners[6], 2);  // of no triangle
}

TEST(CornerColoringTest, ThreeTrianglesMayShareASide) {
  const Triangles book = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {0, 1, 2}};
  ExpectRight(ColorCorners(book, 5), book, 5);
}

TEST(CornerColoringTest, CopiesAreWhereTheirVerticesAre) {
  ClothObject object = test::MakeDerivativeScene("side", 4).objects[0];
  object.triangles = {{5, 0, 1}, {5, 1, 6}, {5, 6, 9}, {5, 9, 4}, {5, 4, 0}};
  const int n = object.num_vertices();
  const CornerColoring coloring = ColorCorners(object.triangles, n);
  ASSERT_FALSE(coloring.copies.empty());
  std::vector<glm::vec4> colors;
  for (int i = 0; i < n; ++i) colors.emplace_back(0.01f * static_cast<float>(i));
  const Surface surface = ClothShape(object).MakeSurface(object.positions, colors);
  ASSERT_EQ(surface.positions.size(), n + coloring.copies.size());
  ASSERT_EQ(surface.normals.size(), surface.positions.size());
  ASSERT_EQ(surface.colors.size(), surface.positions.size());
  for (size_t k = 0; k < coloring.copies.size(); ++k) {
    const int vertex = coloring.copies[k];
    EXPECT_EQ(surface.positions[n + k], surface.positions[vertex]);
    EXPECT_EQ(surface.colors[n + k], surface.colors[vertex]);
    EXPECT_EQ(surface.normals[n + k], surface.normals[vertex]);
  }
  // Normals are those of the cloth, not of what hangs together by numbers.
  std::vector<std::uint32_t> whole;
  for (const auto& t : object.triangles) whole.insert(whole.end(), t.begin(), t.end());
  EXPECT_EQ(surface.normals[5], VertexNormals(ToPoints(object.positions), whole)[5]);
}

}  // namespace
}  // namespace dpe::viewer
