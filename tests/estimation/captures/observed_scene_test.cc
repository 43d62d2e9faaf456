#include "dpe/estimation/observed_scene.h"

#include <limits>

#include "dpe/engine/simulator.h"
#include "estimation/captures/capture_support.h"
#include "support/test_scenes.h"

namespace dpe::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// A cloth of 9 vertices, 6 to 8 fixed, seen over 5 frames.
class ObservedScene : public ::testing::Test {
 protected:
  ObservedScene() {
    observations_.positions = {Eigen::MatrixXd::Constant(27, 5, kNan)};
    for (int v = 6; v < 9; ++v) See(v, 0, Rest(v));
  }
  Eigen::Vector3d Rest(int v) const {
    return original_.objects[0].positions.segment<3>(3 * v);
  }
  void See(int v, int frame, const Eigen::Vector3d& position) {
    observations_.positions[0].col(frame).segment<3>(3 * v) = position;
  }
  const PrescribedPath& PathOf(int v) const {
    for (const PrescribedPath& p : scene_.objects[0].prescribed_paths) {
      if (p.vertex == v) return p;
    }
    throw std::runtime_error("no path");
  }

  const Scene original_ = MakeDerivativeScene("side", 3);
  Scene scene_ = original_;
  Observations observations_;
};

TEST_F(ObservedScene, PinsFollowThroughGaps) {
  const Eigen::Vector3d up(0, 1, 0);
  See(7, 3, Rest(7) + 3.0 * up);
  observations_.positions[0].col(0).segment<3>(24).setConstant(kNan);
  See(8, 2, Rest(8) + up);
  EXPECT_EQ(FollowObservedPins(observations_, "target", &scene_), 3);
  ASSERT_EQ(PathOf(7).positions.cols(), 5);
  for (int f = 0; f < 5; ++f) {
    EXPECT_TRUE(PathOf(6).positions.col(f).isApprox(Rest(6)));
    EXPECT_TRUE(PathOf(7).positions.col(f).isApprox(Rest(7) + std::min(f, 3) * up));
    EXPECT_TRUE(PathOf(8).positions.col(f).isApprox(Rest(8) + up));
  }
  // The vertex begins where its path does, and its springs are as long as they were.
  EXPECT_EQ(scene_.objects[0].positions.tail<3>(), PathOf(8).positions.col(0));
  EXPECT_EQ(RestLengths(scene_.objects[0]), RestLengths(original_.objects[0]));
}

TEST_F(ObservedScene, MarkersBetweenFramesCount) {
  Marker alone{"a", 0, {7}, {1.0}, 0.0};
  Marker corner{"b", 0, {3, 6, 7}, {0.0, 1.0, 0.0}, 0.0};
  Marker mixed{"c", 0, {3, 6, 7}, {0.1, 0.8, 0.1}, 0.0};
  observations_.markers = {alone, corner, mixed};
  observations_.samples = {{0, 0.5, {1, 0, 0}, 0.0},
                           {1, 1.0, {2, 0, 0}, 0.0},
                           {0, 1.5, {3, 0, 0}, 0.0},
                           {2, 2.0, {9, 9, 9}, 0.0}};
  FollowObservedPins(observations_, "target", &scene_);
  EXPECT_TRUE(PathOf(7).positions.col(1).isApprox(Eigen::Vector3d(2, 0, 0)));
  EXPECT_TRUE(PathOf(6).positions.col(1).isApprox(Eigen::Vector3d(2, 0, 0)));
  // A marker beside the vertex says nothing of where the vertex is.
  EXPECT_TRUE(PathOf(6).positions.col(2).isApprox(Eigen::Vector3d(2, 0, 0)));
}

TEST_F(ObservedScene, APinThatIsNeverSeenIsRefused) {
  observations_.positions[0].bottomRows<3>().setConstant(kNan);
  const auto error = [&] {
    return ErrorOf([&] { FollowObservedPins(observations_, "target", &scene_); });
  };
  EXPECT_THAT(error(), AllOf(StartsWith("target: vertex 8 of object 0"),
                             HasSubstr("never observed")));
  PrescribedPath path;
  path.vertex = 8;
  path.positions = Rest(8);
  scene_.objects[0].prescribed_paths = {path};
  EXPECT_EQ(error(), "accepted");
  EXPECT_EQ(PathOf(8).positions.cols(), 1);
  EXPECT_EQ(scene_.objects[0].prescribed_paths.size(), 3u);
  // Again: paths are replaced.
  EXPECT_EQ(error(), "accepted");
  EXPECT_EQ(scene_.objects[0].prescribed_paths.size(), 3u);
}

TEST_F(ObservedScene, ObjectsThatWereNotSeenAreLeftAlone) {
  observations_.positions = {Eigen::MatrixXd()};
  EXPECT_EQ(FollowObservedPins(observations_, "target", &scene_), 0);
  EXPECT_EQ(StartFromObservation(observations_, &scene_), 0);
  EXPECT_TRUE(scene_.objects[0].prescribed_paths.empty());
  EXPECT_EQ(scene_.objects[0].rest_length.size(), 0);
}

TEST_F(ObservedScene, StartsWhereItWasSeen) {
  const Eigen::Vector3d seen = Rest(4) + Eigen::Vector3d(0.1, -0.2, 0.3);
  See(4, 0, seen);
  See(3, 1, {5, 5, 5});  // later is of no use
  EXPECT_EQ(StartFromObservation(observations_, &scene_), 4);
  EXPECT_EQ(scene_.objects[0].positions.segment<3>(12), seen);
  EXPECT_EQ(scene_.objects[0].positions.segment<3>(9), Rest(3));
  EXPECT_EQ(scene_.objects[0].rest_length, RestLengths(original_.objects[0]));
}

// A hand moves a pin; the motion is recovered through the observation of the pin alone.
TEST_F(ObservedScene, TheSimulationFollowsTheHand) {
  Scene truth = original_;
  for (int v = 6; v < 9; ++v) {
    PrescribedPath path;
    path.vertex = v;
    path.positions.resize(3, 30);
    for (int f = 0; f < 30; ++f) {
      path.positions.col(f) = Rest(v) + Eigen::Vector3d(0, 0.001 * f * f, 0.002 * f);
    }
    truth.objects[0].prescribed_paths.push_back(path);
  }
  const Trajectory expected = Simulator(truth).Simulate(30);
  observations_ = ObserveAll(expected);
  observations_.positions[0].topRows(18).setConstant(kNan);
  FollowObservedPins(observations_, "target", &scene_);
  const Trajectory followed = Simulator(scene_).Simulate(30);
  const Trajectory standing = Simulator(original_).Simulate(30);
  EXPECT_LT((followed.positions[0] - expected.positions[0]).norm(), 1e-10);
  EXPECT_GT((standing.positions[0] - expected.positions[0]).norm(), 0.1);
}

}  // namespace
}  // namespace dpe::test
