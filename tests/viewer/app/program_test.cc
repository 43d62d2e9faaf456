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

// Millimetres with z up, as a motion capture writes them, make the picture that metres
// with y up make.
TEST_F(ViewerProgramTest, ATrajectoryIsReadInItsOwnUnits) {
  if (!HasDevice()) GTEST_SKIP() << "there is no Vulkan device";
  const Scene scene = LoadScene(scene_);
  Trajectory trajectory = Simulator(scene).Simulate(8);
  WriteTrajectory(folder_.File("m.csv"), TrajectoryFormat::kCsv, trajectory, scene);
  for (Eigen::MatrixXd& x : trajectory.positions) {
    const Eigen::MatrixXd as_y_up = x;
    for (Eigen::Index r = 0; r < x.rows(); r += 3) {
      x.row(r + 1) = -as_y_up.row(r + 2);
      x.row(r + 2) = as_y_up.row(r + 1);
    }
    x *= 1000.0;
  }
  WriteTrajectory(folder_.File("mm.csv"), TrajectoryFormat::kCsv, trajectory, scene);
  const std::string first = "--first_frame=7";
  ASSERT_EQ(Offscreen({first, "--png=m.png", "--trajectory=m.csv"}).exit_code, 0);
  const std::vector<std::string> units = {"--trajectory_scale=0.001",
                                          "--trajectory_up=z"};
  ASSERT_EQ(
      Offscreen({first, "--png=mm.png", "--trajectory=mm.csv", units[0], units[1]})
          .exit_code,
      0);
  const Image metres = ReadPng(folder_.File("m.png"));
  // Rounding of the last digit moves no more than an edge's sample here and there.
  EXPECT_LT(Difference(ReadPng(folder_.File("mm.png")), metres), 30);
  ASSERT_EQ(
      Offscreen({first, "--png=y.png", "--trajectory=mm.csv", units[0]}).exit_code, 0);
  EXPECT_GT(Difference(ReadPng(folder_.File("y.png")), metres), 500);
  // At twice the scene's rate the file's frame 6 is the scene's frame 3.
  const std::string rate = "--trajectory_rate=" + std::to_string(2.0 / scene.delta);
  const std::string motion = "--trajectory=m.csv", bare = "--nolegend";
  ASSERT_EQ(Offscreen({"--first_frame=3", "--png=a.png", motion, bare, rate}).exit_code,
            0);
  ASSERT_EQ(Offscreen({"--first_frame=6", "--png=b.png", motion, bare}).exit_code, 0);
  EXPECT_EQ(ReadPng(folder_.File("a.png")).rgba, ReadPng(folder_.File("b.png")).rgba);
  ExpectRefused(Offscreen({"--trajectory=m.csv", "--trajectory_up=x"}),
                "--trajectory_up");
  ExpectRefused(Offscreen({"--trajectory=m.csv", "--trajectory_scale=-1"}),
                "--trajectory_scale");
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
