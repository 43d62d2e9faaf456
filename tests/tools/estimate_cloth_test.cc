// What estimate_cloth writes and prints when all goes well.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "dpe/engine/simulator.h"
#include "dpe/estimation/trajectory_io.h"
#include "tools/estimate_cloth_support.h"

namespace dpe::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(EstimateClothTest, WritesSceneTrajectoryAndReport) {
  const ProgramResult result = Run({"--validate_frames=40"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const std::string optimized = output_ + "/cloth.v1_nL_optimized.txt";
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("iteration"), HasSubstr("cost"), HasSubstr("converged"),
                    HasSubstr(optimized), HasSubstr("trajectory.csv"), HasSubstr("N/m"),
                    HasSubstr("40 frames")));
  // No control characters in a pipe.
  EXPECT_THAT(result.out, Not(HasSubstr("\r")));

  // The optimised scene loads, and makes the trajectory that was written.
  const std::string again = folder_.File("again.csv");
  const ProgramResult simulated = RunProgram(
      "simulate_cloth", {"--scene=" + optimized, "--frames=40", "--output=" + again});
  EXPECT_EQ(simulated.exit_code, 0) << simulated.err;
  EXPECT_EQ(ReadFile(again), ReadFile(output_ + "/trajectory.csv"));

  // Nothing else is left behind.
  const std::filesystem::directory_iterator folder(output_);
  EXPECT_EQ(std::distance(begin(folder), end(folder)), 3);
}

TEST_F(EstimateClothTest, ReportHasWhatItPromises) {
  ASSERT_EQ(Run({"--validate_frames=40"}).exit_code, 0);
  const nlohmann::json report = Report();
  EXPECT_EQ(report.at("scene"), path_);
  EXPECT_EQ(report.at("settings"), "nL");
  EXPECT_EQ(report.at("frames"), 20);
  EXPECT_EQ(report.at("solver"), "lm");
  EXPECT_EQ(report.at("init"), "inverse_dynamics");
  EXPECT_EQ(report.at("success"), true);
  EXPECT_EQ(report.at("termination"), "converged");
  EXPECT_EQ(report.at("iterations"), 0);
  EXPECT_GE(report.at("evaluations"), 1);
  EXPECT_EQ(report.at("jacobian_evaluations"), 0);
  EXPECT_GT(report.at("wall_time_s"), 0.0);
  EXPECT_GE(report.at("initial_cost"), report.at("final_cost"));
  EXPECT_LT(report.at("rms_position_error_m"), 1e-9);
  EXPECT_EQ(report.at("validation").at("frames"), 40);
  EXPECT_LT(report.at("validation").at("rms_position_error_m"), 1e-6);
  EXPECT_LT(report.at("parameter_deviation_percent"), 1e-3);
  ASSERT_EQ(report.at("parameters").size(), 1u);
  const nlohmann::json& block = report.at("parameters")[0];
  EXPECT_EQ(block.at("object"), 0);
  EXPECT_EQ(block.at("kind"), "stiffness");
  EXPECT_EQ(block.at("mode"), "L");
  EXPECT_EQ(block.at("unit"), "N/m");
  const size_t num_values = block.at("values").size();
  EXPECT_EQ(block.at("true_values").size(), num_values);
  EXPECT_EQ(block.at("inactive").size(), 4u);  // the springs of the fixed row
  EXPECT_EQ(num_values + 4, scene_.objects[0].springs.size());
  for (const char* key : {"message", "solver_reason", "notes", "jacobian"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
}

TEST_F(EstimateClothTest, WhatIsUnknownIsNull) {
  ASSERT_EQ(Run({"--settings=nG"}).exit_code, 0);
  const nlohmann::json report = Report();
  EXPECT_TRUE(report.at("parameter_deviation_percent").is_null());
  EXPECT_TRUE(report.at("parameters")[0].at("true_values").is_null());
  EXPECT_TRUE(report.at("validation").at("rms_position_error_m").is_null());
}

// The scene's own values serve as truth for a synthetic target only; with a target file
// they may be anything.
TEST_F(EstimateClothTest, ATargetFileGivesTheSameAnswerWhateverTheSceneSays) {
  ASSERT_EQ(Run({"--frames=15"}).exit_code, 0);
  const nlohmann::json own = Report();
  const std::string target = folder_.File("target.csv");
  ASSERT_EQ(RunProgram("simulate_cloth",
                       {"--scene=" + path_, "--frames=30", "--output=" + target})
                .exit_code,
            0);
  const ParameterLayout layout(scene_);
  layout.Insert(Eigen::VectorXd::Constant(layout.size(), 0.1), &scene_);
  SaveScene(scene_, path_);
  const ProgramResult result =
      Run({"--frames=15", "--validate_frames=500", "--target=" + target});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json report = Report();
  EXPECT_EQ(report.at("frames"), 15);
  EXPECT_EQ(report.at("validation").at("frames"), 30);  // as many as the file has
  EXPECT_LT(report.at("validation").at("rms_position_error_m"), 1e-9);
  EXPECT_TRUE(report.at("parameter_deviation_percent").is_null());
  EXPECT_TRUE(report.at("parameters")[0].at("true_values").is_null());
  const std::vector<double> a = own.at("parameters")[0].at("values");
  const std::vector<double> b = report.at("parameters")[0].at("values");
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(b[i], a[i], 1e-9 * a[i]);
}

TEST_F(EstimateClothTest, NoiseIsSeededAndSmoothingItAwayIsNotAnError) {
  const std::vector<std::string> flags = {"--settings=nG", "--noise_sigma=0.001",
                                          "--seed=3", "--validate_frames=40"};
  ASSERT_EQ(Run(flags).exit_code, 0);
  const nlohmann::json first = Report();
  ASSERT_EQ(Run(flags).exit_code, 0);
  EXPECT_EQ(first.at("final_cost"), Report().at("final_cost"));
  EXPECT_GT(first.at("rms_position_error_m"), 1e-3);
}

TEST_F(EstimateClothTest, AllFlagsTogether) {
  const ProgramResult result =
      Run({"--settings=LG", "--solver=lm", "--jacobian=adjoint", "--init=scene",
           "--init_perturbation=0.1", "--seed=7", "--max_iterations=50",
           "--max_seconds=100", "--threads=2", "--frames=10"});
  EXPECT_EQ(result.exit_code, 0) << result.err << result.out;
  const nlohmann::json report = Report();
  EXPECT_EQ(report.at("jacobian"), "adjoint");
  EXPECT_EQ(report.at("init"), "scene");
  EXPECT_EQ(report.at("parameters").size(), 2u);
  EXPECT_GT(report.at("jacobian_evaluations"), 0);
}

TEST_F(EstimateClothTest, DefaultOutputFolderIsNamedAfterSceneAndSettings) {
  RunProgramOptions options;
  options.working_directory = folder_.path();
  const ProgramResult result =
      RunProgram("estimate_cloth",
                 {"--scene=cloth.v1.txt", "--settings=Ln", "--frames=10"}, options);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(std::filesystem::exists(
      folder_.File("results/cloth.v1_Ln/cloth.v1_Ln_optimized.txt")));
}

TEST_F(EstimateClothTest, Help) {
  const ProgramResult result = RunProgram("estimate_cloth", {"--help"});
  EXPECT_EQ(result.exit_code, 0);
  for (const char* flag :
       {"--scene", "--target", "--settings", "--frames", "--validate_frames",
        "--solver", "--jacobian", "--init", "--max_iterations", "--max_seconds",
        "--noise_sigma", "--seed", "--output_dir", "--threads"}) {
    EXPECT_THAT(result.out, HasSubstr(std::string("  ") + flag + " ")) << flag;
  }
}

TEST_F(EstimateClothTest, TheMemoryLimitChangesMemoryAndNothingElse) {
  scene_ = MakeDerivativeScene("side", 20);
  scene_.num_frames = 40;
  ApplySettings("nG", &scene_);
  SaveScene(scene_, path_);
  const auto run = [&](const std::string& limit) {
    const ProgramResult result = Run({"--init=uniform:800", "--solver=lbfgs",
                                      "--max_iterations=1", "--memory_limit=" + limit});
    EXPECT_EQ(result.exit_code, 2) << result.err;
    return std::make_pair(result.peak_mib, Report().at("final_cost").get<double>());
  };
  const auto [peak_without, cost_without] = run("0");
  const auto [peak_with, cost_with] = run("2048");
  EXPECT_GT(peak_with, peak_without + 20.0);  // 39 factorisations of a megabyte
  EXPECT_NEAR(cost_with / cost_without, 1.0, 1e-6);
}

}  // namespace
}  // namespace dpe::test
