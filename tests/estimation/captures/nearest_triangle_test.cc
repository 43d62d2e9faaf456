#include "captures/nearest_triangle.h"

#include <gtest/gtest.h>

#include <random>

#include "support/test_scenes.h"

namespace dpe::test {
namespace {

using Eigen::Vector3d;

const Vector3d kA(0, 0, 0), kB(4, 0, 0), kC(0, 0, 4);

Vector3d Weights(const Vector3d& p) { return NearestInTriangle(p, kA, kB, kC); }

TEST(NearestInTriangleTest, EveryRegionByHand) {
  EXPECT_TRUE(Weights({1, 5, 1}).isApprox(Vector3d(0.5, 0.25, 0.25), 1e-15));
  EXPECT_TRUE(Weights({1, -2, 2}).isApprox(Vector3d(0.25, 0.25, 0.5), 1e-15));
  // Corners.
  EXPECT_EQ(Weights({-1, 3, -2}), Vector3d(1, 0, 0));
  EXPECT_EQ(Weights({6, 1, -1}), Vector3d(0, 1, 0));
  EXPECT_EQ(Weights({-1, 0, 9}), Vector3d(0, 0, 1));
  EXPECT_EQ(Weights(kA), Vector3d(1, 0, 0));
  EXPECT_EQ(Weights(kB), Vector3d(0, 1, 0));
  EXPECT_EQ(Weights(kC), Vector3d(0, 0, 1));
  // Edges: the third weight is exactly 0.
  EXPECT_EQ(Weights({1, 7, -2}), Vector3d(0.75, 0.25, 0));
  EXPECT_EQ(Weights({-3, 1, 3}), Vector3d(0.25, 0, 0.75));
  EXPECT_EQ(Weights({3, 2, 3}), Vector3d(0, 0.5, 0.5));
  EXPECT_EQ(Weights({2, 0, 0}), Vector3d(0.5, 0.5, 0));
}

// No point of a fine grid over the triangle is nearer than the one that was found.
TEST(NearestInTriangleTest, AgainstAllPointsOfAGrid) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto random = [&] {
    return Vector3d(uniform(generator), uniform(generator), uniform(generator));
  };
  constexpr int kCells = 100;
  for (int trial = 0; trial < 100; ++trial) {
    const Vector3d a = random(), b = random(), c = random(), p = 2.0 * random();
    const Vector3d w = NearestInTriangle(p, a, b, c);
    EXPECT_GE(w.minCoeff(), 0.0);
    EXPECT_NEAR(w.sum(), 1.0, 1e-14);
    const double found = (w[0] * a + w[1] * b + w[2] * c - p).norm();
    double least = 1e9;
    for (int i = 0; i <= kCells; ++i) {
      for (int j = 0; i + j <= kCells; ++j) {
        const double v = double(i) / kCells, u = double(j) / kCells;
        least = std::min(least, ((1 - u - v) * a + v * b + u * c - p).norm());
      }
    }
    EXPECT_LE(found, least + 1e-12);
    EXPECT_GE(found, least - 0.03 * 2.0);  // the cells are not larger
  }
}

TEST(FindNearestTriangleTest, TakesTheNearestOfAll) {
  const Scene scene = MakeDerivativeScene("corners", 4);
  const ClothObject& cloth = scene.objects[0];
  // Above the middle of each triangle.
  for (size_t t = 0; t < cloth.triangles.size(); ++t) {
    Vector3d middle = Vector3d::Zero();
    for (int v : cloth.triangles[t]) middle += cloth.positions.segment<3>(3 * v) / 3.0;
    const NearestPoint nearest =
        FindNearestTriangle(middle + Vector3d(0.0, 0.4, 0.0), cloth);
    EXPECT_EQ(nearest.triangle, static_cast<int>(t));
    EXPECT_NEAR(nearest.distance, 0.4, 1e-12);
    EXPECT_TRUE(nearest.weights.isApprox(Vector3d::Constant(1.0 / 3.0), 1e-12));
  }
  // 3 x 3 squares of a third of 7 m and their diagonals.
  EXPECT_NEAR(MeanEdgeLength(cloth), 7.0 / 3.0 * (2.0 + std::sqrt(2.0)) / 3.0, 1e-12);
}

TEST(FindNearestTriangleTest, WithoutTriangles) {
  EXPECT_EQ(FindNearestTriangle({0, 0, 0}, ClothObject()).triangle, -1);
  EXPECT_EQ(MeanEdgeLength(ClothObject()), 0.0);
}

}  // namespace
}  // namespace dpe::test
