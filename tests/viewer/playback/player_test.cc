#include "playback/player.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <thread>
#include <utility>

#include "dpe/engine/simulator.h"
#include "support/test_scenes.h"

namespace dpe::viewer {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Scene TestScene() { return test::MakeDerivativeScene("side", 4); }

Trajectory Simulated(const Scene& scene, int num_frames) {
  return Simulator(scene).Simulate(num_frames);
}

RecordedMotion Recorded(const Scene& scene, int num_frames) {
  return RecordedMotion(ObserveAll(Simulated(scene, num_frames)), scene.delta);
}

bool WaitFor(Player* player) {
  for (int k = 0; k < 10000 && player->IsWaiting(); ++k) {
    player->Update(0.0);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return !player->IsWaiting();
}

TEST(RecordedMotionTest, VelocitiesAreDifferencesAndGapsStayGaps) {
  const Scene scene = TestScene();
  const Trajectory trajectory = Simulated(scene, 6);
  Observations observations = ObserveAll(trajectory);
  observations.positions[0].block<3, 1>(0, 3).setConstant(kNaN);
  const RecordedMotion motion(observations, scene.delta);
  EXPECT_EQ(motion.num_frames(), 6);
  const MotionState state = motion.At(2);
  EXPECT_EQ(state.positions[0], trajectory.positions[0].col(2));
  EXPECT_TRUE(std::isnan(state.velocities[0][0]));  // frame 3 of vertex 0 is missing
  EXPECT_NEAR(state.velocities[0][4],
              (trajectory.positions[0](4, 3) - trajectory.positions[0](4, 1)) /
                  (2.0 * scene.delta),
              1e-12);
  EXPECT_TRUE(std::isnan(motion.At(3).positions[0][2]));
  EXPECT_TRUE(std::isfinite(motion.At(3).positions[0][3]));
  EXPECT_EQ(motion.At(99).positions[0], trajectory.positions[0].col(5));
}

TEST(RecordedMotionTest, DistancesAreOverWhatWasSeen) {
  const Scene scene = TestScene();
  Observations observations = ObserveAll(Simulated(scene, 3));
  MotionState state = RecordedMotion(observations, scene.delta).At(1);
  for (Eigen::Index c = 0; c < state.positions[0].size(); c += 3) {
    state.positions[0].segment<3>(c) += Eigen::Vector3d(0.3, 0.0, 0.4);
  }
  state.positions[0][0] += 100.0;  // of a vertex that was not seen
  observations.positions[0].block<3, 1>(0, 1).setConstant(kNaN);
  const RecordedMotion target(observations, scene.delta);
  EXPECT_NEAR(RmsDistance(target, 1, state), 0.5, 1e-12);
  EXPECT_TRUE(std::isnan(RmsDistance(target, 3, state)));
}

TEST(RecordedMotionTest, MarkersAreSeenAtTheirTimes) {
  const Scene scene = TestScene();
  Observations observations;
  observations.positions.resize(1);
  Marker marker;
  marker.vertices = {0, 1, 2};
  marker.weights = {0.2, 0.3, 0.5};
  observations.markers = {marker};
  observations.samples = {{0, 0.0, {0, 0, 0}, 0.0}, {0, 1.4, {1, 2, 3}, 0.0}};
  const RecordedMotion target(observations, scene.delta);
  EXPECT_FALSE(target.shows_vertices());
  ASSERT_EQ(target.MarkersAt(1).size(), 1);
  EXPECT_EQ(target.MarkersAt(1)[0].position, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(target.MarkersAt(2).size(), 0);
  MotionState state;
  state.positions = {scene.objects[0].positions};
  const Eigen::VectorXd& x = state.positions[0];
  const Eigen::Vector3d there =
      0.2 * x.segment<3>(0) + 0.3 * x.segment<3>(3) + 0.5 * x.segment<3>(6);
  EXPECT_NEAR(RmsDistance(target, 1, state), (there - Eigen::Vector3d(1, 2, 3)).norm(),
              1e-12);
}

TEST(PlayerTest, PlaysARecordingByTheClockOverAndOver) {
  const Scene scene = TestScene();
  PlayerSources sources;
  sources.scene = scene;
  sources.trajectory = Recorded(scene, 5);
  sources.target = Recorded(scene, 5);
  Player player(std::move(sources));
  EXPECT_FALSE(player.is_live());
  EXPECT_EQ(player.last_frame(), 4);
  ASSERT_EQ(player.errors().size(), 5);
  EXPECT_EQ(player.errors()[4], 0.0f);
  player.Update(10.0);
  EXPECT_FALSE(player.Update(11.0));  // paused: nothing changes
  player.SetPaused(false);
  player.Update(11.0 + 2.5 * scene.delta);
  EXPECT_EQ(player.frame(), 2);
  EXPECT_EQ(player.motion().positions[0], Simulated(scene, 3).positions[0].col(2));
  player.Update(11.0 + 4.5 * scene.delta);
  EXPECT_EQ(player.frame(), 4);
  player.Update(11.0 + 5.5 * scene.delta);
  EXPECT_EQ(player.frame(), 0);
  player.Seek(3);
  EXPECT_EQ(player.frame(), 3);
  player.StepBack();
  EXPECT_EQ(player.frame(), 2);
  EXPECT_TRUE(player.paused());
  player.StepForward();
  EXPECT_EQ(player.frame(), 3);
  player.Seek(77);
  EXPECT_EQ(player.frame(), 4);
  player.StepForward();
  EXPECT_EQ(player.frame(), 4);
  player.Restart();
  EXPECT_EQ(player.frame(), 0);
}

TEST(PlayerTest, StepsALiveSimulationAndGoesBackInIt) {
  const Scene scene = TestScene();
  const Trajectory trajectory = Simulated(scene, 8);
  PlayerSources sources;
  sources.scene = scene;
  Scene stiffer = scene;
  stiffer.objects[0].stiffness *= 4.0;
  const Trajectory target = Simulated(stiffer, 8);
  sources.target = RecordedMotion(ObserveAll(target), scene.delta);
  Player player(std::move(sources));
  for (int f = 1; f < 6; ++f) {
    player.StepForward();
    ASSERT_TRUE(WaitFor(&player));
    EXPECT_EQ(player.frame(), f);
    EXPECT_EQ(player.motion().positions[0], trajectory.positions[0].col(f));
    EXPECT_EQ(player.target_state()->positions[0], target.positions[0].col(f));
  }
  ASSERT_EQ(player.errors().size(), 6);
  const Eigen::VectorXd difference =
      trajectory.positions[0].col(5) - target.positions[0].col(5);
  EXPECT_NEAR(player.errors()[5],
              difference.norm() / std::sqrt(scene.objects[0].num_vertices()), 1e-6);
  player.StepBack();
  player.StepBack();
  EXPECT_EQ(player.frame(), 3);
  EXPECT_EQ(player.motion().positions[0], trajectory.positions[0].col(3));
  player.StepForward();
  EXPECT_EQ(player.frame(), 4);  // of what is remembered
  player.Seek(1);
  EXPECT_EQ(player.frame(), 1);
  EXPECT_EQ(player.last_frame(), 5);
  player.Restart();
  ASSERT_TRUE(WaitFor(&player));
  EXPECT_EQ(player.frame(), 0);
  EXPECT_EQ(player.last_frame(), 0);
  player.StepForward();
  ASSERT_TRUE(WaitFor(&player));
  EXPECT_EQ(player.motion().positions[0], trajectory.positions[0].col(1));
}

TEST(PlayerTest, TwoScenesMoveInStep) {
  const Scene scene = TestScene();
  Scene other = scene;
  other.objects[0].stiffness *= 0.3;
  PlayerSources sources;
  sources.scene = scene;
  sources.compared = other;
  Player player(std::move(sources));
  for (int f = 1; f < 4; ++f) {
    player.StepForward();
    ASSERT_TRUE(WaitFor(&player));
  }
  EXPECT_EQ(player.motion().positions[0], Simulated(scene, 4).positions[0].col(3));
  EXPECT_EQ(player.compared_motion()->positions[0],
            Simulated(other, 4).positions[0].col(3));
}

TEST(HistoryTest, ForgetsTheOldestAndFindsWhatIsNearest) {
  Moment moment;
  moment.motions.resize(1);
  moment.motions[0].positions = {Eigen::VectorXd::Zero(30)};
  History history(4 * moment.motions[0].bytes());
  for (const int frame : {0, 1, 3, 4, 7, 8}) {
    moment.frame = frame;
    moment.motions[0].positions[0].setConstant(frame);
    history.Add(moment);
  }
  EXPECT_EQ(history.first_frame(), 3);
  EXPECT_EQ(history.last_frame(), 8);
  EXPECT_EQ(history.At(6).frame, 4);
  EXPECT_EQ(history.At(7).motions[0].positions[0][5], 7.0);
  EXPECT_EQ(history.At(0).frame, 3);
  EXPECT_EQ(history.At(99).frame, 8);
  EXPECT_EQ(history.After(4).frame, 7);
}

}  // namespace
}  // namespace dpe::viewer
