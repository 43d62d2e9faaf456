#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "dpe/engine/scene_io.h"
#include "dpe/engine/simulator.h"
#include "dpe/estimation/attach.h"
#include "dpe/estimation/capture.h"
#include "dpe/estimation/trajectory_io.h"
#include "support/run_program.h"
#include "support/temp_dir.h"
#include "support/test_scenes.h"

namespace dpe::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class SimulateClothTest : public ::testing::Test {
 protected:
  SimulateClothTest() { SaveScene(scene_, path_); }

  ProgramResult Run(std::vector<std::string> flags) {
    flags.push_back("--scene=" + path_);
    flags.push_back("--output=" + output_);
    return RunProgram("simulate_cloth", flags);
  }

  const TempDir folder_;
  const std::string path_ = folder_.File("scene.txt");
  const std::string output_ = folder_.File("out.csv");
  Scene scene_ = MakeDerivativeScene("two_objects", 4);
};

TEST_F(SimulateClothTest, WritesWhatTheSimulatorSays) {
  const ProgramResult result = Run({"--frames=7"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("7 frames"));
  const Observations read = ReadTrajectoryCsv(output_, scene_, 0);
  const Trajectory expected = Simulator(scene_).Simulate(7);
  for (int object = 0; object < 2; ++object) {
    EXPECT_EQ(read.positions[object], expected.positions[object]);
  }
}

TEST_F(SimulateClothTest, WritesTheFormatAskedFor) {
  const Trajectory expected = Simulator(scene_).Simulate(5);
  const auto expect = [&](const std::string& output, const std::string& format,
                          const std::string& is) {
    const ProgramResult result = RunProgram(
        "simulate_cloth",
        {"--scene=" + path_, "--frames=5", "--output=" + output, "--format=" + format});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("5 frames to"));
    Capture capture = ReadCapture(output);
    EXPECT_EQ(capture.format, is);
    ToSceneUnits({}, scene_.delta, &capture);
    const Observations read = AttachCapture(capture, scene_);
    for (int object = 0; object < 2; ++object) {
      EXPECT_TRUE(read.positions[object].isApprox(expected.positions[object], 1e-6));
    }
  };
  expect(folder_.File("out.npy"), "auto", "NPY");
  expect(folder_.File("out.dat"), "pc2", "PC2");
  expect(folder_.File("out.npy"), "csv", "CSV");
  expect(folder_.File("frames/cloth_*.obj"), "auto", "OBJ");
  const ProgramResult shorter =
      RunProgram("simulate_cloth", {"--scene=" + path_, "--frames=4",
                                    "--output=" + folder_.File("frames/cloth_*.obj")});
  EXPECT_EQ(shorter.exit_code, 1);
  EXPECT_THAT(shorter.err, HasSubstr("cloth_0004.obj"));
  const ProgramResult unknown = Run({"--format=bvh"});
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_THAT(unknown.err, AllOf(HasSubstr("--format"), HasSubstr("bvh")));
}

TEST_F(SimulateClothTest, FlagsTakeTheSceneValuesPlace) {
  const ProgramResult result =
      Run({"--frames=4", "--integrator=implicit_euler", "--delta=0.01",
           "--steps_per_frame=2", "--threads=2"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  scene_.integration_method = IntegrationMethod::kImplicitEuler;
  scene_.delta = 0.01;
  scene_.steps_per_frame = 2;
  EXPECT_EQ(ReadTrajectoryCsv(output_, scene_, 0).positions[0],
            Simulator(scene_).Simulate(4).positions[0]);
  ASSERT_EQ(Run({}).exit_code, 0);
  EXPECT_EQ(ReadTrajectoryCsv(output_, scene_, 0).num_frames(), scene_.num_frames);
}

TEST_F(SimulateClothTest, CtrlCKeepsTheFramesSoFar) {
  RunProgramOptions options;
  options.interrupt_after = 1.0;
  const ProgramResult result = RunProgram(
      "simulate_cloth", {"--scene=" + path_, "--output=" + output_, "--frames=200000"},
      options);
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_LT(result.seconds, 60.0);
  EXPECT_THAT(result.err, HasSubstr("interrupted"));
  EXPECT_GT(ReadTrajectoryCsv(output_, scene_, 0).num_frames(), 10);
}

TEST_F(SimulateClothTest, TimesAreShownWhenAskedFor) {
  EXPECT_THAT(Run({"--frames=20", "--print_times"}).out,
              AllOf(HasSubstr("factorisation"), HasSubstr("total")));
  EXPECT_THAT(Run({"--frames=20"}).out, Not(HasSubstr("factorisation")));
  scene_.print_times = true;  // the scene's own wish
  SaveScene(scene_, path_);
  EXPECT_THAT(Run({"--frames=20"}).out, HasSubstr("factorisation"));
  EXPECT_THAT(Run({"--frames=20", "--integrator=0", "--delta=0.0001"}).out,
              Not(HasSubstr("factorisation")));
}

TEST_F(SimulateClothTest, AFailureKeepsTheFramesBeforeIt) {
  const ProgramResult result =
      Run({"--frames=200", "--integrator=explicit_euler", "--delta=0.5"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, AllOf(HasSubstr("object"), HasSubstr("frame")));
  const int frames = ReadTrajectoryCsv(output_, scene_, 0).num_frames();
  EXPECT_GT(frames, 1);
  EXPECT_LT(frames, 200);
}

TEST_F(SimulateClothTest, BadFlagsAndInput) {
  EXPECT_EQ(RunProgram("simulate_cloth", {}).exit_code, 1);
  EXPECT_THAT(RunProgram("simulate_cloth", {"--scene=x"}).err, HasSubstr("--output"));
  const ProgramResult absent = RunProgram(
      "simulate_cloth", {"--scene=" + folder_.File("absent"), "--output=" + output_});
  EXPECT_EQ(absent.exit_code, 1);
  EXPECT_THAT(absent.err, HasSubstr("absent"));
  const ProgramResult frames = Run({"--frames=-1"});
  EXPECT_EQ(frames.exit_code, 1);
  EXPECT_THAT(frames.err, AllOf(HasSubstr("--frames"), HasSubstr("-1")));
  EXPECT_THAT(Run({"--delta=nan"}).err, HasSubstr("--delta"));
  EXPECT_THAT(Run({"--threads=0"}).err, HasSubstr("--threads"));
  const ProgramResult integrator = Run({"--integrator=euler"});
  EXPECT_EQ(integrator.exit_code, 1);
  EXPECT_THAT(integrator.err, AllOf(HasSubstr("euler"), HasSubstr("implicit_euler")));
  const ProgramResult output = RunProgram(
      "simulate_cloth", {"--scene=" + path_, "--output=" + folder_.File("no/out.csv")});
  EXPECT_EQ(output.exit_code, 1);
  EXPECT_THAT(output.err, HasSubstr("no/out.csv"));
}

TEST_F(SimulateClothTest, Help) {
  const ProgramResult result = RunProgram("simulate_cloth", {"--help"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, AllOf(HasSubstr("--integrator"), HasSubstr("Usage")));
}

}  // namespace
}  // namespace dpe::test
