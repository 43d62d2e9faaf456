#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "c_api_support.h"
#include "dpe/engine/scene_io.h"
#include "dpe/engine/simulator.h"
#include "support/scene_text.h"
#include "support/temp_dir.h"
#include "support/test_scenes.h"

namespace dpe::test {
namespace {

using ::testing::HasSubstr;

class SceneApiTest : public ::testing::Test {
 protected:
  SceneApiTest() {
    EXPECT_DPE_OK(dpe_scene_create_from_json(DPE_C_VERSION,
                                             SceneToJson(expected_).c_str(), &scene_));
  }

  // That every object is where it should be at a frame.
  void ExpectFrame(const Trajectory& trajectory, int frame) {
    for (int o = 0; o < static_cast<int>(expected_.objects.size()); ++o) {
      const ReadPositions read = Read(scene_, o, expected_.objects[o].num_vertices());
      EXPECT_EQ(read.frame, frame);
      const Eigen::VectorXf is =
          Eigen::VectorXf::Map(read.positions.data(), read.positions.size());
      EXPECT_EQ(is, trajectory.positions[o].col(frame).cast<float>()) << "object " << o;
    }
  }

  Scene expected_ = MakeDerivativeScene("two_objects", 4);
  OwnedScene scene_;
};

TEST_F(SceneApiTest, StepsAsTheSimulatorDoes) {
  const Trajectory trajectory = Simulator(expected_).Simulate(8);
  ExpectFrame(trajectory, 0);
  for (int f = 1; f < 8; ++f) {
    ASSERT_DPE_OK(dpe_scene_step(scene_, 1));
    ExpectFrame(trajectory, f);
  }
  ASSERT_DPE_OK(dpe_scene_stop(scene_));
  ExpectFrame(trajectory, 0);
  ASSERT_DPE_OK(dpe_scene_step(scene_, 5));
  ExpectFrame(trajectory, 5);
}

TEST_F(SceneApiTest, SaysWhatItIsMadeOf) {
  dpe_scene_info info;
  ASSERT_DPE_OK(dpe_scene_get_info(scene_, &info));
  EXPECT_EQ(info.num_objects, 2);
  EXPECT_EQ(info.frame_length, expected_.delta);
  EXPECT_EQ(info.state, DPE_STOPPED);
  const ClothObject& cloth = expected_.objects[1];
  dpe_object_info object;
  ASSERT_DPE_OK(dpe_scene_get_object_info(scene_, 1, &object));
  EXPECT_EQ(object.num_vertices, cloth.num_vertices());
  EXPECT_EQ(object.num_springs, cloth.num_springs());
  std::vector<std::int32_t> springs(2 * object.num_springs);
  std::int32_t count = 0;
  EXPECT_EQ(dpe_scene_get_springs(scene_, 1, springs.data(), 2, &count),
            DPE_ERROR_BUFFER);
  EXPECT_EQ(count, springs.size());
  ASSERT_DPE_OK(dpe_scene_get_springs(scene_, 1, springs.data(), count, &count));
  EXPECT_EQ(springs[2], cloth.springs[1][0]);
  EXPECT_EQ(springs[3], cloth.springs[1][1]);
  std::vector<std::int32_t> triangles(3 * object.num_triangles);
  ASSERT_DPE_OK(dpe_scene_get_triangles(scene_, 1, triangles.data(),
                                        static_cast<std::int32_t>(triangles.size()),
                                        &count));
  EXPECT_EQ(triangles[5], cloth.triangles[1][2]);
  std::vector<std::uint8_t> fixed(object.num_vertices);
  ASSERT_DPE_OK(
      dpe_scene_get_fixed(scene_, 1, fixed.data(), object.num_vertices, nullptr));
  EXPECT_EQ(std::vector<char>(fixed.begin(), fixed.end()), cloth.is_fixed);
}

TEST_F(SceneApiTest, RunsOnItsOwnInRealTime) {
  const int frames = 12;
  const Trajectory trajectory = Simulator(expected_).Simulate(400);
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_DPE_OK(dpe_scene_start(scene_));
  EXPECT_EQ(dpe_scene_step(scene_, 1), DPE_ERROR_STATE);
  ReadPositions read;
  do {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    read = Read(scene_, 0, expected_.objects[0].num_vertices());
  } while (read.frame < frames);
  const std::chrono::duration<double> elapsed =
      std::chrono::steady_clock::now() - begin;
  // It may be late, on a busy machine, but never early.
  EXPECT_GT(elapsed.count(), 0.99 * frames * expected_.delta);
  ASSERT_DPE_OK(dpe_scene_pause(scene_));
  dpe_scene_info info;
  ASSERT_DPE_OK(dpe_scene_get_info(scene_, &info));
  EXPECT_EQ(info.state, DPE_PAUSED);
  std::this_thread::sleep_for(std::chrono::duration<double>(3 * expected_.delta));
  const int frame = static_cast<int>(info.frame);
  ASSERT_DPE_OK(dpe_scene_get_info(scene_, &info));
  EXPECT_EQ(info.frame, frame) << "it went on while it was paused";
  ASSERT_LT(frame, 400);
  ExpectFrame(trajectory, frame);
}

TEST_F(SceneApiTest, RateIsRelativeToRealTime) {
  ASSERT_DPE_OK(dpe_scene_set_rate(scene_, 1e-9));
  ASSERT_DPE_OK(dpe_scene_start(scene_));
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(Read(scene_, 0, expected_.objects[0].num_vertices()).frame, 0);
  ASSERT_DPE_OK(dpe_scene_set_rate(scene_, 0.0));
  std::int64_t frame = 0;
  while (frame < 30) frame = Read(scene_, 0, expected_.objects[0].num_vertices()).frame;
  EXPECT_EQ(dpe_scene_set_rate(scene_, -1.0), DPE_ERROR_ARGUMENT);
  EXPECT_EQ(dpe_scene_set_rate(scene_, std::nan("")), DPE_ERROR_ARGUMENT);
}

// A scene as fast as possible computes frames without a pause; whoever calls gets a
// turn.
TEST_F(SceneApiTest, NobodyWaitsForAFastScene) {
  ASSERT_DPE_OK(dpe_scene_set_rate(scene_, 0.0));
  ASSERT_DPE_OK(dpe_scene_start(scene_));
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(dpe_scene_step(scene_, 1), DPE_ERROR_STATE);
    dpe_scene_info info;
    EXPECT_DPE_OK(dpe_scene_get_info(scene_, &info));
  }
  // Nor for one that another thread steps.
  ASSERT_DPE_OK(dpe_scene_pause(scene_));
  dpe_scene_info before, info;
  ASSERT_DPE_OK(dpe_scene_get_info(scene_, &before));
  std::thread stepper([this] { dpe_scene_step(scene_, 1000000000); });
  do {
    ASSERT_EQ(dpe_scene_get_info(scene_, &info), DPE_OK);
  } while (info.frame < before.frame + 20);
  EXPECT_DPE_OK(dpe_scene_stop(scene_));
  stepper.join();
}

TEST_F(SceneApiTest, CopiesOnlyWhatIsNew) {
  const int n = expected_.objects[0].num_vertices();
  const ReadPositions first = Read(scene_, 0, n);
  EXPECT_EQ(first.is_new, 1);
  const ReadPositions again = Read(scene_, 0, n, first.sequence);
  EXPECT_EQ(again.is_new, 0);
  EXPECT_EQ(again.positions, std::vector<float>(3 * n));
  ASSERT_DPE_OK(dpe_scene_step(scene_, 1));
  EXPECT_EQ(Read(scene_, 0, n, first.sequence).is_new, 1);
  // Back at frame 0, which is another state than that of the beginning for a reader.
  ASSERT_DPE_OK(dpe_scene_stop(scene_));
  const ReadPositions stopped = Read(scene_, 0, n, first.sequence);
  EXPECT_EQ(stopped.is_new, 1);
  EXPECT_EQ(stopped.frame, 0);
  std::vector<float> small(3 * n - 1);
  std::uint64_t sequence = 0;
  std::int32_t is_new = 0;
  EXPECT_EQ(dpe_scene_copy_positions(scene_, 0, small.data(), 3 * n - 1, &sequence,
                                     nullptr, &is_new),
            DPE_ERROR_BUFFER);
}

TEST_F(SceneApiTest, SavedSceneIsTheSame) {
  const TempDir folder;
  const std::string path = folder.File("tücher.txt");
  ASSERT_DPE_OK(dpe_scene_step(scene_, 3));
  ASSERT_DPE_OK(dpe_scene_save(scene_, path.c_str()));
  EXPECT_EQ(ReadFile(path), SceneToJson(expected_));
  EXPECT_EQ(dpe_scene_save(scene_, "/nowhere/scene.txt"), DPE_ERROR_INPUT);
}

TEST(SceneApiErrorTest, MessagesNameFileAndPlace) {
  dpe_scene scene = 77;
  EXPECT_EQ(dpe_scene_create_from_file(DPE_C_VERSION, "nowhere.txt", &scene),
            DPE_ERROR_INPUT);
  EXPECT_THAT(LastError(), HasSubstr("nowhere.txt"));
  EXPECT_EQ(scene, 77) << "outputs are not written by a failure";
  const std::string text = EditedSceneText("[10, 20]", "[10, -20]");
  EXPECT_EQ(dpe_scene_create_from_json(DPE_C_VERSION, text.c_str(), &scene),
            DPE_ERROR_INPUT);
  EXPECT_THAT(LastError(), HasSubstr("springStiffness"));
  EXPECT_EQ(dpe_scene_create_from_file(DPE_C_VERSION, "\xFF", &scene),
            DPE_ERROR_ARGUMENT);
  EXPECT_EQ(dpe_scene_create_from_file(DPE_C_VERSION, nullptr, &scene),
            DPE_ERROR_ARGUMENT);
  EXPECT_EQ(dpe_scene_create_from_file(DPE_C_VERSION + 1, "side.txt", &scene),
            DPE_ERROR_VERSION);
  EXPECT_EQ(dpe_check_version(DPE_C_VERSION + (1 << 16)), DPE_ERROR_VERSION);
  EXPECT_THAT(LastError(), HasSubstr("2.0"));
  EXPECT_STREQ(dpe_status_name(DPE_ERROR_VERSION), "DPE_ERROR_VERSION");
  EXPECT_STREQ(dpe_status_name(-1), "unknown status");
}

TEST(SceneApiErrorTest, SimulationThatBreaksDownSaysWhere) {
  Scene scene = MakeDerivativeScene("corners", 4);
  scene.integration_method = IntegrationMethod::kExplicitEuler;
  scene.objects[0].stiffness *= 1e6;
  OwnedScene handle;
  ASSERT_DPE_OK(
      dpe_scene_create_from_json(DPE_C_VERSION, SceneToJson(scene).c_str(), &handle));
  EXPECT_EQ(dpe_scene_step(handle, 10000), DPE_ERROR_SIMULATION);
  EXPECT_THAT(LastError(handle), HasSubstr("frame"));
  dpe_scene_info info;
  ASSERT_DPE_OK(dpe_scene_get_info(handle, &info));
  EXPECT_EQ(info.state, DPE_FAILED);
  ASSERT_DPE_OK(dpe_scene_stop(handle));
  ASSERT_DPE_OK(dpe_scene_step(handle, 1));
}

TEST(SceneApiErrorTest, DestroyedHandlesStayInvalid) {
  const std::string text = SmallSceneText();
  dpe_scene first = 0, second = 0;
  ASSERT_DPE_OK(dpe_scene_create_from_json(DPE_C_VERSION, text.c_str(), &first));
  EXPECT_EQ(dpe_playback_start(first), DPE_ERROR_HANDLE) << "it is a scene";
  ASSERT_DPE_OK(dpe_scene_destroy(first));
  EXPECT_EQ(dpe_scene_destroy(first), DPE_ERROR_HANDLE);
  ASSERT_DPE_OK(dpe_scene_create_from_json(DPE_C_VERSION, text.c_str(), &second));
  EXPECT_NE(first, second);
  EXPECT_EQ(dpe_scene_step(first, 1), DPE_ERROR_HANDLE);
  EXPECT_THAT(LastError(), HasSubstr("not the handle of a live scene"));
  ASSERT_DPE_OK(dpe_shutdown());
  EXPECT_EQ(dpe_live_handles(), 0);
  EXPECT_EQ(dpe_scene_step(second, 1), DPE_ERROR_HANDLE);
}

}  // namespace
}  // namespace dpe::test
