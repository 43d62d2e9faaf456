// dpe_viewer as its users run it, without a window.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "dpe/engine/scene_io.h"
#include "dpe/engine/simulator.h"
#include "dpe/estimation/trajectory_io.h"
#include "png/png.h"
#include "support/run_program.h"
#include "support/temp_dir.h"
#include "support/test_scenes.h"

namespace dpe::viewer {
namespace {

using test::ProgramResult;
using test::RunProgram;

class ViewerProgramTest : public testing::Test {
 protected:
  ViewerProgramTest() { SaveScene(test::MakeDerivativeScene("side", 6), scene_); }
  static bool HasDevice() {
    return RunProgram("dpe_viewer", {"--list_devices"}).out.rfind("0", 0) == 0;
  }
  ProgramResult Offscreen(std::vector<std::string> flags) {
    flags.insert(flags.begin(), {scene_, "--offscreen", "--size=160x120"});
    test::RunProgramOptions options;
    options.working_directory = folder_.path();
    return RunProgram("dpe_viewer", flags, options);
  }
  static void ExpectRefused(const ProgramResult& result, const std::string& what) {
    EXPECT_EQ(result.exit_code, 1) << result.out;
    EXPECT_NE(result.err.find(what), std::string::npos) << result.err;
  }

  const test::TempDir folder_;
  const std::string scene_ = folder_.File("side.txt");
};

// Pixels that differ by more than a little.
int Difference(const Image& a, const Image& b) {
  int count = 0;
  for (size_t k = 0; k < a.rgba.size(); ++k)
    count += std::abs(a.rgba[k] - b.rgba[k]) > 16;
  return count;
}

TEST_F(ViewerProgramTest, SaysWhatIsWrongWithItsInput) {
  ExpectRefused(RunProgram("dpe_viewer", {}), "no scene is given");
  ExpectRefused(RunProgram("dpe_viewer", {folder_.File("none.txt")}), "none.txt");
  test::WriteFile(folder_.File("bad.txt"), "{\"delta\": 0.02, \"objects\": []}");
  ExpectRefused(RunProgram("dpe_viewer", {folder_.File("bad.txt")}),
                "bad.txt: objects: an empty array");
  ExpectRefused(Offscreen({"--color=rainbow"}), "rainbow");
  ExpectRefused(Offscreen({"--color=deviation"}), "--report");
  ExpectRefused(Offscreen({"--size=12"}), "--size: \"12\"");
  ExpectRefused(Offscreen({"--show=everything"}), "everything");
  ExpectRefused(Offscreen({"--frames=3", "--png=out.png"}), "out_%04d.png");
  ExpectRefused(Offscreen({"--target=none.csv"}), "none.csv");
  ExpectRefused(Offscreen({"--device=no such card", "--png=a.png"}), "no such card");
  ExpectRefused(RunProgram("dpe_viewer", {scene_, "another"}), "another");
}

TEST_F(ViewerProgramTest, DrawsFramesThatMoveAndDoSoAlikeEveryTime) {
  if (!HasDevice()) GTEST_SKIP() << "there is no Vulkan device";
  const ProgramResult result =
      Offscreen({"--frames=21", "--every=10", "--png=out_%03d.png", "--validation"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_NE(result.out.find("3 pictures"), std::string::npos) << result.out;
  const Image first = ReadPng(folder_.File("out_000.png"));
  const Image last = ReadPng(folder_.File("out_020.png"));
  EXPECT_EQ(first.width, 160);
  EXPECT_EQ(first.height, 120);
  EXPECT_GT(Difference(first, last), 500);
  ASSERT_EQ(Offscreen({"--first_frame=20", "--png=again.png"}).exit_code, 0);
  EXPECT_EQ(ReadPng(folder_.File("again.png")).rgba, last.rgba);
}

TEST_F(ViewerProgramTest, ARecordedMotionIsDrawnAsTheSimulatedOne) {
  if (!HasDevice()) GTEST_SKIP() << "there is no Vulkan device";
  const Scene scene = LoadScene(scene_);
  const Trajectory trajectory = Simulator(scene).Simulate(12);
  WriteTrajectory(folder_.File("motion.csv"), TrajectoryFormat::kCsv, trajectory,
                  scene);
  const std::string first = "--first_frame=11";
  ASSERT_EQ(Offscreen({first, "--png=live.png"}).exit_code, 0);
  ASSERT_EQ(Offscreen({first, "--png=played.png", "--trajectory=motion.csv"}).exit_code,
            0);
  const Image live = ReadPng(folder_.File("live.png"));
  EXPECT_EQ(ReadPng(folder_.File("played.png")).rgba, live.rgba);
  // Over itself as a target the estimate's wireframe is all that is new; and every
  // format is read.
  WriteTrajectory(folder_.File("motion.npy"), TrajectoryFormat::kNpy, trajectory,
                  scene);
  const ProgramResult result =
      Offscreen({first, "--png=target.png", "--target=motion.npy"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  int green = 0;
  const Image target = ReadPng(folder_.File("target.png"));
  for (size_t k = 0; k < target.rgba.size(); k += 4) {
    green += target.rgba[k + 1] > target.rgba[k] + 60 &&
             target.rgba[k + 1] > target.rgba[k + 2] + 60;
  }
  EXPECT_GT(green, 300);
}

TEST_F(ViewerProgramTest, AFailingSimulationStopsWithItsReason) {
  if (!HasDevice()) GTEST_SKIP() << "there is no Vulkan device";
  Scene scene = LoadScene(scene_);
  scene.integration_method = IntegrationMethod::kExplicitEuler;
  scene.objects[0].stiffness *= 1e8;
  SaveScene(scene, scene_);
  const ProgramResult result = Offscreen({"--frames=100", "--png=f_%d.png"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.err.find("frame"), std::string::npos) << result.err;
}

TEST_F(ViewerProgramTest, WritesAVideo) {
  if (!HasDevice()) GTEST_SKIP() << "there is no Vulkan device";
  if (std::system("command -v ffprobe > /dev/null 2>&1") != 0) {
    GTEST_SKIP() << "ffmpeg is not installed";
  }
  // An odd size, and a name that a shell would take apart.
  ASSERT_EQ(
      Offscreen({"--frames=5", "--video=it's; $HOME.mp4", "--size=161x121"}).exit_code,
      0);
  const ProgramResult probe =
      RunProgram("/usr/bin/env", {"ffprobe", "-v", "error", "-count_frames",
                                  "-show_entries", "stream=width,height,nb_read_frames",
                                  "-of", "csv", folder_.File("it's; $HOME.mp4")});
  EXPECT_NE(probe.out.find("162,122,5"), std::string::npos) << probe.out << probe.err;
}

}  // namespace
}  // namespace dpe::viewer
