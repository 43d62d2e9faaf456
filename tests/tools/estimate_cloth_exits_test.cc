// Exit codes and messages of estimate_cloth when something is in the way.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "dpe/engine/cloth_builder.h"
#include "tools/estimate_cloth_support.h"

namespace dpe::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class EstimateClothExitsTest : public EstimateClothTest {
 protected:
  // Runs with the flags, expects exit code 1, returns what was said.
  std::string Refused(const std::vector<std::string>& flags) {
    const ProgramResult result = Run(flags);
    EXPECT_EQ(result.exit_code, 1) << result.out;
    EXPECT_THAT(result.err, HasSubstr("estimate_cloth: error: "));
    return result.err;
  }
};

TEST_F(EstimateClothExitsTest, BadFlagsNameFlagValueAndWhatIsAccepted) {
  EXPECT_THAT(RunProgram("estimate_cloth", {}).err, HasSubstr("--scene"));
  EXPECT_THAT(Refused({"--solver=newton"}),
              AllOf(HasSubstr("--solver"), HasSubstr("newton"), HasSubstr("lbfgs")));
  EXPECT_THAT(Refused({"--jacobian=x"}), AllOf(HasSubstr("adjoint"), HasSubstr("x")));
  EXPECT_THAT(Refused({"--init=here"}), AllOf(HasSubstr("here"), HasSubstr("screen")));
  EXPECT_THAT(Refused({"--init=uniform:"}), HasSubstr("--init"));
  EXPECT_THAT(Refused({"--init=uniform:-1"}), HasSubstr("above 0"));
  EXPECT_THAT(Refused({"--init=uniform:1x"}), HasSubstr("1x"));
  EXPECT_THAT(Refused({"--horizon=half"}),
              AllOf(HasSubstr("half"), HasSubstr("shooting")));
  EXPECT_THAT(Refused({"--settings=nX"}), HasSubstr("X"));
  EXPECT_THAT(Refused({"--settings=nn"}), HasSubstr("nothing is estimated"));
  EXPECT_THAT(Refused({"--settings=nL,nL"}), HasSubstr("nL,nL"));
  EXPECT_THAT(Refused({"--frames=1"}), HasSubstr("--frames"));
  EXPECT_THAT(Refused({"--frames=-5"}), AllOf(HasSubstr("--frames"), HasSubstr("-5")));
  EXPECT_THAT(Refused({"--noise_sigma=-1"}), HasSubstr("--noise_sigma"));
  EXPECT_THAT(Refused({"--max_seconds=nan"}), HasSubstr("--max_seconds"));
  EXPECT_THAT(Refused({"--threads=0"}), HasSubstr("--threads"));
  EXPECT_THAT(
      Refused({"--memory_limit=-1"}),
      AllOf(HasSubstr("--memory_limit"), HasSubstr("-1"), HasSubstr("least 0")));
  EXPECT_EQ(Run({"--no_such_flag"}).exit_code, 1);
  EXPECT_EQ(Run({"--frames=ten"}).exit_code, 1);
}

TEST_F(EstimateClothExitsTest, BadFilesAreNamed) {
  EXPECT_THAT(RunProgram("estimate_cloth", {"--scene=absent.txt"}).err,
              HasSubstr("absent.txt"));
  EXPECT_THAT(Refused({"--target=absent.csv"}), HasSubstr("absent.csv"));
  const std::string target = folder_.File("target.csv");
  WriteFile(target, "frame,vertex,x,y,z\n0,0,1,2,3\n1,99,1,2,3\n");
  EXPECT_THAT(Refused({"--target=" + target}),
              HasSubstr(target + ":3: vertex is '99'"));
  WriteFile(target, "frame,vertex,x,y,z\n0,0,1,2,3\n1,0,1,2,3\n");
  EXPECT_THAT(Refused({"--target=" + target, "--frames=3"}),
              AllOf(HasSubstr("--frames: 3"), HasSubstr(target)));
  WriteFile(folder_.File("file"), "");
  const ProgramResult result =
      RunProgram("estimate_cloth",
                 {"--scene=" + path_, "--output_dir=" + folder_.File("file/out")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("--output_dir"), HasSubstr("file/out")));
}

TEST_F(EstimateClothExitsTest, TwoAndTheBestSoFarWhereItStopsEarly) {
  for (const char* limit : {"--max_iterations=2", "--max_seconds=0.02"}) {
    const ProgramResult result = Run({"--init=uniform:20", limit});
    EXPECT_EQ(result.exit_code, 2) << limit << result.out;
    EXPECT_TRUE(std::filesystem::exists(output_ + "/cloth.v1_nL_optimized.txt"));
    EXPECT_EQ(Report().at("success"), false);
    EXPECT_LE(Report().at("final_cost"), Report().at("initial_cost"));
  }
  EXPECT_EQ(Report().at("termination"), "max_seconds");
}

TEST_F(EstimateClothExitsTest, TwoAndEverythingWrittenAfterCtrlC) {
  // Large enough to be still busy when the signal comes.
  PresetOptions preset;
  preset.rows = preset.cols = 12;
  scene_ = MakePresetScene(ScenePreset::kCorners, preset);
  SaveScene(scene_, path_);
  RunProgramOptions options;
  options.interrupt_after = 3.0;
  const ProgramResult result = Run({"--init=uniform:10", "--frames=30"}, options);
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_FALSE(result.timed_out);
  EXPECT_THAT(result.out, HasSubstr("interrupted"));
  EXPECT_EQ(Report().at("termination"), "interrupted");
  EXPECT_GT(std::filesystem::file_size(output_ + "/trajectory.csv"), 1000u);
  EXPECT_NO_THROW(LoadScene(output_ + "/cloth.v1_nL_optimized.txt"));
}

TEST_F(EstimateClothExitsTest, ThreeWhereTheStartCannotBeSimulated) {
  scene_.integration_method = IntegrationMethod::kSymplecticEuler;
  SaveScene(scene_, path_);
  const ProgramResult result = Run({"--init=uniform:10000000", "--horizon=full"});
  EXPECT_EQ(result.exit_code, 3) << result.out;
  EXPECT_THAT(result.out, HasSubstr("--init=screen"));
  EXPECT_EQ(Report().at("termination"), "start_failed");
  EXPECT_TRUE(Report().at("final_cost").is_null());
  EXPECT_FALSE(std::filesystem::exists(output_ + "/cloth.v1_nL_optimized.txt"));
  const ProgramResult screened = Run({"--init=screen", "--max_iterations=3"});
  EXPECT_NE(screened.exit_code, 3) << screened.out;
  EXPECT_FALSE(Report().at("final_cost").is_null());
}

TEST_F(EstimateClothExitsTest, ASceneWhoseOwnMotionFailsIsBadInput) {
  scene_.integration_method = IntegrationMethod::kExplicitEuler;
  scene_.delta = 0.5;
  SaveScene(scene_, path_);
  EXPECT_THAT(Refused({"--frames=100"}),
              AllOf(HasSubstr("own motion"), HasSubstr("frame")));
}

}  // namespace
}  // namespace dpe::test
