#include "dpe/estimation/observations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "dpe/engine/simulator.h"
#include "support/test_scenes.h"

namespace dpe {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Trajectory SmallTrajectory(const Scene& scene) { return Simulator(scene).Simulate(5); }

TEST(ObservationsTest, GapsAreSeenAsSuch) {
  const Scene scene = test::MakeDerivativeScene("side", 3);
  Observations obs = ObserveAll(SmallTrajectory(scene));
  EXPECT_EQ(obs.num_frames(), 5);
  EXPECT_EQ(obs.NumObserved(0), 5 * 9);
  EXPECT_TRUE(obs.IsComplete(scene, 0));
  obs.positions[0](3 * 2 + 1, 4) = kNan;
  EXPECT_FALSE(obs.IsObserved(0, 2, 4));
  EXPECT_TRUE(obs.IsObserved(0, 2, 3));
  EXPECT_EQ(obs.NumObserved(0), 5 * 9 - 1);
  EXPECT_FALSE(obs.IsComplete(scene, 0));
  EXPECT_FALSE(obs.IsObserved(1, 0, 0));
  EXPECT_FALSE(obs.IsObserved(0, 9, 0));
  EXPECT_FALSE(obs.IsObserved(0, 0, 5));
}

TEST(ObservationsTest, FixedVerticesMayBeMissing) {
  const Scene scene = test::MakeDerivativeScene("side", 3);
  Observations obs = ObserveAll(SmallTrajectory(scene));
  ASSERT_TRUE(scene.objects[0].is_fixed[8]);
  obs.positions[0].bottomRows<3>().setConstant(kNan);
  EXPECT_TRUE(obs.IsComplete(scene, 0));
}

TEST(RmsTest, IsPerVertexAndFrame) {
  const Scene scene = test::MakeDerivativeScene("side", 3);
  const Trajectory trajectory = SmallTrajectory(scene);
  Observations obs = ObserveAll(trajectory);
  EXPECT_EQ(RmsPositionError(trajectory, obs, 5), 0.0);
  // One vertex off by 3-4-12 (length 13) in one frame, of 5 frames x 9 vertices.
  obs.positions[0].col(2).segment<3>(9) += Eigen::Vector3d(3.0, 4.0, 12.0);
  EXPECT_NEAR(RmsPositionError(trajectory, obs, 5), 13.0 / std::sqrt(45.0), 1e-12);
  // What was not observed does not count.
  obs.positions[0].col(4).setConstant(kNan);
  EXPECT_NEAR(RmsPositionError(trajectory, obs, 5), 13.0 / std::sqrt(36.0), 1e-12);
  EXPECT_EQ(RmsPositionError(trajectory, obs, 2), 0.0);
  obs.positions[0].setConstant(kNan);
  EXPECT_TRUE(std::isnan(RmsPositionError(trajectory, obs, 5)));
}

TEST(AddNoiseTest, IsRepeatableAndLeavesWhatIsGivenAlone) {
  const Scene scene = test::MakeDerivativeScene("side", 3);
  const Observations clean = ObserveAll(SmallTrajectory(scene));
  Observations a = clean, b = clean, c = clean;
  AddNoise(scene, 0.1, 7, &a);
  AddNoise(scene, 0.1, 7, &b);
  AddNoise(scene, 0.1, 8, &c);
  EXPECT_EQ(a.positions[0], b.positions[0]);
  EXPECT_NE(a.positions[0], c.positions[0]);
  EXPECT_EQ(a.positions[0].col(0), clean.positions[0].col(0));
  for (int v = 0; v < 9; ++v) {
    const bool moved = a.positions[0].col(3).segment<3>(3 * v) !=
                       clean.positions[0].col(3).segment<3>(3 * v);
    EXPECT_EQ(moved, !scene.objects[0].is_fixed[v]) << v;
  }
}

TEST(AddNoiseTest, HasTheStandardDeviationAskedFor) {
  const Scene scene = test::MakeDerivativeScene("side", 12);
  const Observations clean = ObserveAll(Simulator(scene).Simulate(30));
  Observations noisy = clean;
  AddNoise(scene, 0.02, 1, &noisy);
  const double sum = (noisy.positions[0] - clean.positions[0]).squaredNorm();
  const double count = 29.0 * 3.0 * 132.0;
  EXPECT_NEAR(std::sqrt(sum / count), 0.02, 0.0005);
}

}  // namespace
}  // namespace dpe
