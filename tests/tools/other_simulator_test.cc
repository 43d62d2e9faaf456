// A recording by another simulator, whose forces ours does not have, from files to
// figures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/run_program.h"
#include "support/temp_dir.h"

namespace dpe::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(OtherSimulatorTest, FitsTheFirstHalfAndForetellsTheSecond) {
  const TempDir folder;
  const std::string frames = folder.File("frames"), output = folder.File("out");
  ASSERT_EQ(RunProgram("fem_cloth", {"--output", frames}).exit_code, 0);
  const ProgramResult fit =
      RunProgram("estimate_cloth",
                 {"--target=" + frames, "--rest_shape=uv", "--target_rate=30",
                  "--density=0.2", "--settings=nR", "--estimate=damping,drag",
                  "--frames=25", "--validate_frames=50", "--output_dir=" + output});
  ASSERT_EQ(fit.exit_code, 0) << fit.out << fit.err;
  EXPECT_THAT(fit.out, AllOf(HasSubstr("held out"), HasSubstr("were determined"),
                             HasSubstr("errors of the model")));
  const auto report = nlohmann::json::parse(ReadFile(output + "/report.json"));
  EXPECT_TRUE(report["scene"].is_null());
  // The cloth swings by its own length, 1 m.
  EXPECT_LT(report["rms_position_error_m"], 0.03);
  EXPECT_LT(report["validation"]["held_out_rms_position_error_m"], 0.03);
  EXPECT_GT(report["uncertainty"]["residual_correlation"], 0.8);
  EXPECT_THAT(report["uncertainty"]["determined"].get<std::string>(),
              HasSubstr("5 parameters were determined"));
}

TEST(OtherSimulatorTest, FlagsThatMakeAClothAreForTargetsWithoutAScene) {
  const ProgramResult both = RunProgram(
      "estimate_cloth",
      {"--scene=" DPE_SOURCE_DIR "/data/side.txt", "--density=0.2", "--frames=5"});
  EXPECT_EQ(both.exit_code, 1);
  EXPECT_THAT(both.err, AllOf(HasSubstr("--density"), HasSubstr("--scene")));
  const ProgramResult bad =
      RunProgram("estimate_cloth", {"--target=x", "--integrator=fem"});
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_THAT(bad.err, AllOf(HasSubstr("--integrator"), HasSubstr("fem")));
}

}  // namespace
}  // namespace dpe::test
