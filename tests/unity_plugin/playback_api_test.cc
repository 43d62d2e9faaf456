#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "c_api_support.h"
#include "dpe/engine/scene_io.h"
#include "dpe/engine/simulator.h"
#include "dpe/estimation/trajectory_io.h"
#include "support/temp_dir.h"
#include "support/test_scenes.h"

namespace dpe::test {
namespace {

using ::testing::HasSubstr;

class PlaybackApiTest : public ::testing::Test {
 protected:
  PlaybackApiTest() {
    EXPECT_DPE_OK(dpe_scene_create_from_json(DPE_C_VERSION, SceneToJson(given_).c_str(),
                                             &scene_));
    motion_ = Simulator(given_).Simulate(kFrames);
    WriteTrajectory(path_, TrajectoryFormat::kCsv, motion_, given_);
    EXPECT_DPE_OK(
        dpe_playback_create(DPE_C_VERSION, scene_, path_.c_str(), &playback_));
  }

  // The frame that is shown; its positions have to be those of the recording.
  int Frame() {
    int shown = -1;
    for (int o = 0; o < static_cast<int>(given_.objects.size()); ++o) {
      std::vector<float> positions(3 * given_.objects[o].num_vertices());
      std::uint64_t sequence = 0;
      std::int64_t frame = -1;
      std::int32_t is_new = 0;
      EXPECT_DPE_OK(dpe_playback_copy_positions(
          playback_, o, positions.data(), static_cast<std::int32_t>(positions.size()),
          &sequence, &frame, &is_new));
      EXPECT_EQ(is_new, 1);
      const Eigen::VectorXf is =
          Eigen::VectorXf::Map(positions.data(), positions.size());
      EXPECT_EQ(is, motion_.positions[o].col(frame).cast<float>());
      shown = static_cast<int>(frame);
    }
    return shown;
  }

  dpe_playback_info Info() {
    dpe_playback_info info;
    EXPECT_DPE_OK(dpe_playback_get_info(playback_, &info));
    return info;
  }

  static constexpr int kFrames = 9;
  const TempDir folder_;
  const std::string path_ = folder_.File("motion.csv");
  const Scene given_ = MakeDerivativeScene("two_objects", 4);
  Trajectory motion_;
  OwnedScene scene_;
  OwnedHandle playback_{dpe_playback_destroy};
};

TEST_F(PlaybackApiTest, SeeksEveryFrame) {
  EXPECT_EQ(Info().num_frames, kFrames);
  for (int f = 0; f < kFrames; ++f) {
    ASSERT_DPE_OK(dpe_playback_seek(playback_, f * given_.delta));
    EXPECT_EQ(Frame(), f);
  }
  ASSERT_DPE_OK(dpe_playback_seek(playback_, 1e9));
  EXPECT_EQ(Frame(), kFrames - 1);
  ASSERT_DPE_OK(dpe_playback_seek(playback_, -1.0));
  EXPECT_EQ(Frame(), 0);
  EXPECT_EQ(dpe_playback_seek(playback_, std::nan("")), DPE_ERROR_ARGUMENT);
}

TEST_F(PlaybackApiTest, PlaysToTheEndAndOver) {
  ASSERT_DPE_OK(dpe_playback_set_rate(playback_, 2.0));
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_DPE_OK(dpe_playback_start(playback_));
  int last = 0;
  while (Info().state == DPE_RUNNING) {
    const int frame = Frame();
    EXPECT_GE(frame, last);
    last = frame;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  const std::chrono::duration<double> elapsed =
      std::chrono::steady_clock::now() - begin;
  EXPECT_GE(elapsed.count(), (kFrames - 1) * given_.delta / 2.0);
  EXPECT_EQ(Info().state, DPE_PAUSED);
  EXPECT_EQ(Frame(), kFrames - 1);
  ASSERT_DPE_OK(dpe_playback_set_rate(playback_, 1e-9));
  ASSERT_DPE_OK(dpe_playback_start(playback_));
  EXPECT_EQ(Frame(), 0);
  ASSERT_DPE_OK(dpe_playback_stop(playback_));
  EXPECT_EQ(Info().state, DPE_STOPPED);
}

TEST_F(PlaybackApiTest, LoopsForwardsAndBackwards) {
  ASSERT_DPE_OK(dpe_playback_set_loop(playback_, 1));
  for (double rate : {1e4, -1e4}) {
    ASSERT_DPE_OK(dpe_playback_set_rate(playback_, rate));
    ASSERT_DPE_OK(dpe_playback_start(playback_));
    for (int i = 0; i < 20; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      const int frame = Frame();
      EXPECT_GE(frame, 0);
      EXPECT_LT(frame, kFrames);
    }
    EXPECT_EQ(Info().state, DPE_RUNNING);
    ASSERT_DPE_OK(dpe_playback_pause(playback_));
    const double time = Info().time;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    EXPECT_EQ(Info().time, time);
  }
  // Backwards without a loop it begins at the end.
  ASSERT_DPE_OK(dpe_playback_set_loop(playback_, 0));
  ASSERT_DPE_OK(dpe_playback_seek(playback_, 0.0));
  ASSERT_DPE_OK(dpe_playback_set_rate(playback_, -1e-9));
  ASSERT_DPE_OK(dpe_playback_start(playback_));
  EXPECT_GE(Frame(), kFrames - 2);
}

TEST_F(PlaybackApiTest, OutlivesItsScene) {
  ASSERT_DPE_OK(dpe_scene_destroy(scene_));
  EXPECT_EQ(Frame(), 0);
}

TEST_F(PlaybackApiTest, RecordingsWithGapsAreRefused) {
  const std::string text = ReadFile(path_);
  const std::size_t last = text.rfind('\n', text.size() - 2);
  WriteFile(path_, text.substr(0, last + 1));
  dpe_playback other = 0;
  EXPECT_EQ(dpe_playback_create(DPE_C_VERSION, scene_, path_.c_str(), &other),
            DPE_ERROR_INPUT);
  EXPECT_THAT(LastError(), HasSubstr("missing at frame 8"));
  EXPECT_EQ(dpe_playback_create(DPE_C_VERSION, scene_, "nowhere.csv", &other),
            DPE_ERROR_INPUT);
  EXPECT_EQ(dpe_playback_create(DPE_C_VERSION, playback_, path_.c_str(), &other),
            DPE_ERROR_HANDLE);
}

}  // namespace
}  // namespace dpe::test
