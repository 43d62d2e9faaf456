// The main job: the presets' 726 stiffnesses and 144 masses from their motion, by the
// program's defaults, in seconds.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <tuple>

#include "support/run_program.h"
#include "support/temp_dir.h"

namespace dpe::test {
namespace {

class RecoveryTest
    : public ::testing::TestWithParam<std::tuple<std::string, std::string>> {};

TEST_P(RecoveryTest, ParametersAndMotionFarBeyondTheFit) {
  const auto& [preset, settings] = GetParam();
  const TempDir folder;
  const ProgramResult result = RunProgram(
      "estimate_cloth",
      {"--scene=" DPE_SOURCE_DIR "/data/" + preset + ".txt", "--settings=" + settings,
       "--validate_frames=500", "--output_dir=" + folder.path()});
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  const nlohmann::json report =
      nlohmann::json::parse(ReadFile(folder.File("report.json")));
  EXPECT_LE(report.at("rms_position_error_m"), 1e-9);
  EXPECT_EQ(report.at("validation").at("frames"), 500);
  EXPECT_LE(report.at("validation").at("rms_position_error_m"), 1e-6);
  EXPECT_LE(report.at("parameter_deviation_percent"), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Presets, RecoveryTest,
                         ::testing::Combine(::testing::Values("side", "corners", "flag",
                                                              "flag_no_wind"),
                                            ::testing::Values("nL", "Ln")),
                         [](const auto& info) {
                           return std::get<0>(info.param) + "_" +
                                  std::get<1>(info.param);
                         });

}  // namespace
}  // namespace dpe::test
