// A job whose scenes and targets are in memory gives what the same job gives with
// files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/scene_io.h"
#include "dpe/estimation/estimation_job.h"
#include "dpe/estimation/trajectory_io.h"
#include "estimation/fit_support.h"
#include "support/temp_dir.h"
#include "support/test_scenes.h"

namespace dpe {
namespace {

using ::testing::HasSubstr;

constexpr int kFrames = 12;

class MemoryJobTest : public ::testing::Test {
 protected:
  MemoryJobTest() {
    scene_ = test::MakeDerivativeScene("side", 4);
    scene_.num_frames = kFrames;
    ApplySettings("nR", &scene_);
    Trajectory motion = Simulator(scene_).Simulate(kFrames);
    // As a CSV file holds them, which has all digits.
    target_ = ObserveAll(motion);
    scene_path_ = dir_.File("scene.txt");
    target_path_ = dir_.File("target.csv");
    SaveScene(scene_, scene_path_);
    WriteTrajectory(target_path_, TrajectoryFormat::kCsv, motion, scene_);
    from_files_.scene_paths = {scene_path_};
    from_files_.target_paths = {target_path_};
    in_memory_.scenes = {LoadScene(scene_path_)};
    in_memory_.targets = {target_};
    for (EstimationJob* job : {&from_files_, &in_memory_}) {
      job->options.init = InitMethod::kUniform;
      job->options.uniform_value = 20.0;
    }
  }

  static EstimatorSummary Run(const EstimationJob& job) {
    EstimationInput input = LoadEstimationInput(job);
    ModelSelection selection;
    return RunEstimation(job.options, nullptr, &input, &selection);
  }

  test::TempDir dir_;
  Scene scene_;
  Observations target_;
  std::string scene_path_, target_path_;
  EstimationJob from_files_, in_memory_;
};

TEST_F(MemoryJobTest, FindsWhatTheSameJobWithFilesFinds) {
  const EstimatorSummary files = Run(from_files_);
  const EstimatorSummary memory = Run(in_memory_);
  EXPECT_EQ(memory.termination, files.termination);
  EXPECT_EQ(memory.iterations, files.iterations);
  EXPECT_EQ(memory.parameters, files.parameters);
  EXPECT_EQ(memory.final_rms, files.final_rms);
  EXPECT_LT(memory.final_rms, 1.0);
}

TEST_F(MemoryJobTest, WithoutATargetTheScenesOwnMotionIsFitted) {
  in_memory_.targets.clear();
  in_memory_.settings = "nL";
  in_memory_.options.init = InitMethod::kAuto;
  EstimationInput input = LoadEstimationInput(in_memory_);
  EXPECT_TRUE(input.truth_is_known);
  const EstimatorSummary summary =
      RunEstimation(in_memory_.options, nullptr, &input, nullptr);
  EXPECT_LT(summary.final_rms, 1e-10);
  EXPECT_LT(ParameterDeviationPercent(summary, input.captures[0].scene), 1e-4);
}

TEST_F(MemoryJobTest, OneSceneServesSeveralTargetsAndNoiseDiffersBetweenThem) {
  in_memory_.targets = {target_, target_};
  in_memory_.noise_sigma = 1e-3;
  const EstimationInput input = LoadEstimationInput(in_memory_);
  ASSERT_EQ(input.captures.size(), 2u);
  EXPECT_NE(input.captures[0].target.positions[0],
            input.captures[1].target.positions[0]);
  // On free vertices, after frame 0.
  double sum = 0.0;
  int count = 0;
  for (int i = 0; i < scene_.objects[0].num_vertices(); ++i) {
    if (scene_.objects[0].is_fixed[i]) continue;
    for (int frame = 1; frame < kFrames; ++frame, ++count) {
      sum += (input.captures[0].target.positions[0] - target_.positions[0])
                 .col(frame)
                 .segment<3>(3 * i)
                 .squaredNorm();
    }
  }
  EXPECT_NEAR(std::sqrt(sum / (3 * count)), 1e-3, 1e-4);
}

TEST_F(MemoryJobTest, WhatDoesNotFitIsRefused) {
  in_memory_.scenes.push_back(in_memory_.scenes[0]);
  in_memory_.targets.assign(3, target_);
  try {
    LoadEstimationInput(in_memory_);
    ADD_FAILURE() << "accepted";
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(), HasSubstr("2 scenes and 3 targets"));
  }
  in_memory_.scenes.clear();
  in_memory_.targets.clear();
  EXPECT_THROW(LoadEstimationInput(in_memory_), SceneError);
}

TEST_F(MemoryJobTest, ResultsAreWrittenUnderTheJobsName) {
  in_memory_.output_dir = dir_.File("results");
  EstimationInput input = LoadEstimationInput(in_memory_);
  const EstimatorSummary summary =
      RunEstimation(in_memory_.options, nullptr, &input, nullptr);
  const std::vector<std::string> paths =
      WriteResults(in_memory_, input, summary, Validate(summary, input, 1),
                   PrepareOutputDir(in_memory_, input));
  ASSERT_EQ(paths.size(), 3u);
  for (const std::string& path : paths)
    EXPECT_TRUE(std::filesystem::exists(path)) << path;
  EXPECT_EQ(LoadScene(paths[0]).objects[0].stiffness,
            summary.scene.objects[0].stiffness);
}

}  // namespace
}  // namespace dpe
