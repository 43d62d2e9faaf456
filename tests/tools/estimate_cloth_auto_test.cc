// estimate_cloth --settings auto: the choice between models.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "dpe/engine/parameters.h"
#include "tools/estimate_cloth_support.h"

namespace dpe::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class EstimateClothAutoTest : public EstimateClothTest {
 protected:
  // A cloth with one stiffness per kind of spring.
  void UseGroups() {
    ApplySettings("nR", &scene_);
    const ParameterLayout layout(scene_);
    layout.Insert(layout.Extract(scene_), &scene_);
    ApplySettings("nL", &scene_);
    SaveScene(scene_, path_);
  }
};

TEST_F(EstimateClothAutoTest, ChoosesAndReports) {
  UseGroups();
  const ProgramResult result = Run({"--settings=auto", "--validate_frames=40"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("settings auto"),
                                HasSubstr("Candidate nG: 1 parameter, "),
                                HasSubstr("Candidate nR: 3 parameters"),
                                HasSubstr("Chosen nR: 3 parameters, 20 frames"),
                                HasSubstr("Chosen: nR forecasts the held-out frames")));
  const nlohmann::json report = Report();
  EXPECT_EQ(report.at("settings"), "nR");
  EXPECT_EQ(report.at("frames"), 20);
  EXPECT_LT(report.at("parameter_deviation_percent"), 1e-3);
  EXPECT_LT(report.at("validation").at("rms_position_error_m"), 1e-6);
  const nlohmann::json& selection = report.at("model_selection");
  EXPECT_EQ(selection.at("chosen"), "nR");
  EXPECT_EQ(selection.at("frames"), 20);
  EXPECT_EQ(selection.at("fitted_frames"), 13);
  EXPECT_EQ(selection.at("held_out_frames"), 7);
  EXPECT_THAT(selection.at("criterion"), HasSubstr("forecast of the last 7 frames"));
  EXPECT_THAT(selection.at("reason"), HasSubstr("nR"));
  const nlohmann::json& rows = selection.at("candidates");
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].at("settings"), "nG");
  EXPECT_EQ(rows[0].at("parameters"), 1);
  EXPECT_TRUE(rows[0].at("weight").is_null());
  EXPECT_GT(rows[0].at("held_out_rms_m"), 1e-4);
  EXPECT_EQ(rows[1].at("settings"), "nR");
  EXPECT_EQ(rows[1].at("kept"), true);
  EXPECT_EQ(rows[1].at("compared_with"), "nG");
  EXPECT_EQ(rows[1].at("termination"), "converged");
  EXPECT_NEAR(rows[1].at("weight"), 1.0, 1e-3);
  EXPECT_LT(rows[1].at("held_out_rms_m"), 1e-6);
  EXPECT_EQ(rows[2].at("settings"), "nL");
  EXPECT_EQ(rows[2].at("kept"), false);
  EXPECT_TRUE(rows[2].at("termination").is_null());
  EXPECT_TRUE(rows[2].at("fit_rms_m").is_null());
  EXPECT_THAT(rows[2].at("reason"), HasSubstr("nothing to explain"));
  EXPECT_TRUE(std::filesystem::exists(output_ + "/cloth.v1_nR_optimized.txt"));
}

TEST_F(EstimateClothAutoTest, TheTableIsAligned) {
  UseGroups();
  const std::string out = Run({"--settings=auto"}).out;
  const std::regex line(
      "\\n(settings|nG      |nR      |nL      ) .{55}  (kept|yes |no  )");
  EXPECT_EQ(std::distance(std::sregex_iterator(out.begin(), out.end(), line),
                          std::sregex_iterator()),
            4)
      << out;
}

TEST_F(EstimateClothAutoTest, WithoutItThereIsNoChoiceInTheReport) {
  ASSERT_EQ(Run({"--settings=nR"}).exit_code, 0);
  EXPECT_FALSE(Report().contains("model_selection"));
}

TEST_F(EstimateClothAutoTest, TheDefaultFolderSaysThatItWasChosen) {
  UseGroups();
  RunProgramOptions options;
  options.working_directory = folder_.path();
  const ProgramResult result = RunProgram(
      "estimate_cloth", {"--scene=cloth.v1.txt", "--settings=auto"}, options);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(std::filesystem::exists(
      folder_.File("results/cloth.v1_auto/cloth.v1_nR_optimized.txt")));
}

TEST_F(EstimateClothAutoTest, BadCombinationsSayWhatIsAccepted) {
  const auto refused = [&](std::vector<std::string> flags) {
    const ProgramResult result = Run(flags);
    EXPECT_EQ(result.exit_code, 1) << result.out;
    return result.err;
  };
  EXPECT_THAT(refused({"--settings=automatic"}),
              AllOf(HasSubstr("\"automatic\""), HasSubstr("expected auto")));
  EXPECT_THAT(refused({"--settings=auto,nn"}), HasSubstr("2 objects"));
  EXPECT_THAT(refused({"--settings=auto", "--frames=5"}),
              AllOf(HasSubstr("5 frames"), HasSubstr("6 or more")));
  for (const char* flag : {"--checkpoint=", "--resume="}) {
    EXPECT_THAT(refused({"--settings=auto", flag + folder_.File("c")}),
                AllOf(HasSubstr("checkpoint"), HasSubstr("settings that were chosen")));
  }
  EXPECT_FALSE(std::filesystem::exists(folder_.File("c")));
}

TEST_F(EstimateClothAutoTest, RunningOutOfTimeIsExitCodeTwoAndWritesTheBestSoFar) {
  // Large enough to be still busy: the truth is one value per spring.
  scene_ = MakeDerivativeScene("corners", 12);
  SaveScene(scene_, path_);
  const ProgramResult result =
      Run({"--settings=auto", "--init=uniform:10", "--frames=100", "--max_seconds=4"});
  EXPECT_EQ(result.exit_code, 2) << result.out << result.err;
  EXPECT_EQ(Report().at("termination"), "max_seconds");
  EXPECT_FALSE(Report().at("rms_position_error_m").is_null());
  EXPECT_LT(result.seconds, 20.0);
  EXPECT_TRUE(std::filesystem::exists(output_ + "/cloth.v1_" +
                                      std::string(Report().at("settings")) +
                                      "_optimized.txt"));
}

}  // namespace
}  // namespace dpe::test
