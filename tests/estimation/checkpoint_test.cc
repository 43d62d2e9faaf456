// Checkpoint files, and fits that are continued from them.
#include "dpe/estimation/checkpoint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "dpe/estimation/estimator.h"
#include "estimation/fit_support.h"
#include "support/derivative_checker.h"
#include "support/scene_text.h"
#include "support/temp_dir.h"
#include "support/test_scenes.h"

namespace dpe {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

Checkpoint SomeCheckpoint() {
  Checkpoint checkpoint;
  checkpoint.problem = {{"scene", "0123"}, {"init", "uniform:10"}};
  checkpoint.stage = "grow";
  checkpoint.init = "uniform";
  checkpoint.notes = {"a \"note\"\n"};
  checkpoint.num_frames = 12;
  checkpoint.horizons = {{6, 4, std::numeric_limits<double>::quiet_NaN(), 1e-3},
                         {12, 2, 0.1, 0.0}};
  checkpoint.iterations = 6;
  checkpoint.first_iteration = 4;
  checkpoint.radius = 1.0 / 3.0;
  checkpoint.seconds = 12.5;
  checkpoint.initial_cost = std::numeric_limits<double>::quiet_NaN();
  checkpoint.initial_rms = std::numeric_limits<double>::quiet_NaN();
  checkpoint.cost = 1e-300;
  checkpoint.start = test::RandomVector(6, 1);
  checkpoint.coordinates = test::RandomVector(6, 2);
  checkpoint.coordinates[0] = std::nextafter(1.0, 2.0);
  checkpoint.coordinates[1] = -5e-324;
  checkpoint.coordinates[2] = std::numeric_limits<double>::max();
  return checkpoint;
}

std::string ErrorOf(const std::string& text) {
  try {
    ParseCheckpoint(text, "fit.json");
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

// SomeCheckpoint's text with `from` replaced.
std::string ErrorOfEdited(const std::string& from, const std::string& to) {
  std::string text = CheckpointToJson(SomeCheckpoint());
  const size_t position = text.find(from);
  EXPECT_NE(position, std::string::npos) << from;
  return ErrorOf(text.replace(position, from.size(), to));
}

TEST(CheckpointFileTest, ReadsBackToTheSameNumbers) {
  const Checkpoint expected = SomeCheckpoint();
  const Checkpoint read = ParseCheckpoint(CheckpointToJson(expected), "fit.json");
  EXPECT_EQ(read.problem, expected.problem);
  EXPECT_EQ(read.stage, "grow");
  EXPECT_EQ(read.init, "uniform");
  EXPECT_EQ(read.notes, expected.notes);
  EXPECT_EQ(read.num_frames, 12);
  ASSERT_EQ(read.horizons.size(), 2u);
  EXPECT_TRUE(std::isnan(read.horizons[0].start_rms));
  EXPECT_EQ(read.horizons[1].iterations, 2);
  EXPECT_EQ(read.horizons[1].start_rms, 0.1);
  EXPECT_EQ(read.iterations, 6);
  EXPECT_EQ(read.first_iteration, 4);
  EXPECT_EQ(read.radius, expected.radius);
  EXPECT_EQ(read.seconds, 12.5);
  EXPECT_TRUE(std::isnan(read.initial_cost));
  EXPECT_TRUE(std::isnan(read.initial_rms));
  EXPECT_EQ(read.cost, 1e-300);
  EXPECT_EQ(read.start, expected.start);
  EXPECT_EQ(read.coordinates, expected.coordinates);
}

TEST(CheckpointFileTest, EveryPartOfAFileIsRefused) {
  const std::string text = CheckpointToJson(SomeCheckpoint());
  const size_t end = text.rfind('}');
  for (size_t size = 0; size <= end; ++size) {
    EXPECT_THAT(ErrorOf(text.substr(0, size)),
                HasSubstr("fit.json: is not a checkpoint, or only part of one"))
        << size;
  }
  EXPECT_EQ(ErrorOf(text), "");
}

TEST(CheckpointFileTest, WhatIsNotACheckpointIsRefused) {
  EXPECT_THAT(ErrorOf("frame,vertex,x,y,z\n"), HasSubstr("is not a checkpoint"));
  EXPECT_THAT(ErrorOf(std::string(300, '\0')), HasSubstr("is not a checkpoint"));
  EXPECT_THAT(ErrorOf("[1, 2]"), HasSubstr("is not a checkpoint"));
  EXPECT_THAT(ErrorOf(test::SmallSceneText()), HasSubstr("no \"format\""));
  EXPECT_THAT(ErrorOfEdited("dpe checkpoint", "other"), HasSubstr("no \"format\""));
  EXPECT_THAT(ErrorOfEdited("\"version\": 1", "\"version\": 2"),
              AllOf(HasSubstr("version 2"), HasSubstr("reads version 1")));
  EXPECT_THAT(ErrorOfEdited("\"version\"", "\"v\""), HasSubstr("version is missing"));
}

TEST(CheckpointFileTest, WrongMembersAreNamed) {
  EXPECT_THAT(ErrorOfEdited("\"grow\"", "\"shrink\""),
              AllOf(HasSubstr("stage is \"shrink\""), HasSubstr("start, grow or fit")));
  EXPECT_THAT(ErrorOfEdited("\"radius\"", "\"r\""), HasSubstr("radius is missing"));
  EXPECT_THAT(ErrorOfEdited("\"seconds\": 12.5", "\"seconds\": -1"),
              HasSubstr("seconds is -1"));
  EXPECT_THAT(ErrorOfEdited("\"iterations\": 6", "\"iterations\": 6.5"),
              HasSubstr("iterations is 6.5"));
  EXPECT_THAT(ErrorOfEdited("1.0000000000000002", "null"),
              HasSubstr("coordinates is [null"));
  EXPECT_THAT(ErrorOfEdited("1.0000000000000002,", ""),
              HasSubstr("as many numbers as coordinates"));
  EXPECT_THAT(ErrorOfEdited("\"0123\"", "3"), HasSubstr("problem is "));
}

TEST(CheckpointFileTest, AnAbsentFileIsNamed) {
  const test::TempDir folder;
  try {
    ReadCheckpoint(folder.File("absent.json"));
    ADD_FAILURE();
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr("absent.json"), HasSubstr("No such file")));
  }
}

class ResumeTest : public ::testing::Test {
 protected:
  ResumeTest() {
    test::Perturb(2, &scene_);
    // Not what made the target: the optimum is not 0.
    ApplySettings("nR", &scene_);
    scene_.objects[0].estimate_damping = true;
    target_ = test::OwnMotion(scene_, kFrames);
    options_.init = InitMethod::kUniform;
    options_.uniform_value = 20.0;
    options_.horizon = Horizon::kFull;
  }

  // Fits and keeps the file that every iteration finds, by stage.
  EstimatorSummary FitAndKeepCheckpoints() {
    EstimatorOptions options = options_;
    options.checkpoint_path = path_;
    options.progress = [&](const IterationReport& report) {
      costs_.resize(report.iteration + 1);
      costs_[report.iteration] = report.cost;
      if (std::filesystem::exists(path_)) {
        checkpoints_.push_back(ReadCheckpoint(path_));
      }
    };
    return Estimate(scene_, target_, options);
  }

  EstimatorSummary Resume(const Checkpoint& checkpoint, EstimatorOptions options) {
    WriteCheckpoint(checkpoint, path_);
    options.resume_path = path_;
    return Estimate(scene_, target_, options);
  }

  void ExpectSameOptimumFromEveryCheckpoint(double tolerance) {
    const EstimatorSummary expected = FitAndKeepCheckpoints();
    EXPECT_TRUE(expected.usable()) << expected.message;
    ASSERT_GT(checkpoints_.size(), 4u);
    for (size_t i = 0; i < checkpoints_.size(); ++i) {
      const EstimatorSummary resumed = Resume(checkpoints_[i], options_);
      EXPECT_TRUE(resumed.usable()) << i << resumed.message;
      EXPECT_LT((resumed.parameters - expected.parameters).norm(),
                tolerance * expected.parameters.norm())
          << i;
      EXPECT_EQ(resumed.init, expected.init);
      EXPECT_EQ(resumed.initial_cost, expected.initial_cost);
      EXPECT_GE(resumed.iterations, checkpoints_[i].iterations);
    }
  }

  std::string ErrorOfResuming(const Checkpoint& checkpoint) {
    try {
      Resume(checkpoint, options_);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "accepted";
  }

  static constexpr int kFrames = 20;
  Scene scene_ = test::MakeDerivativeScene("side", 5);
  Observations target_;
  EstimatorOptions options_;
  const test::TempDir folder_;
  const std::string path_ = folder_.File("fit.json");
  std::vector<Checkpoint> checkpoints_;
  std::vector<double> costs_;
};

TEST_F(ResumeTest, FromAnyIterationToTheSameOptimum) {
  ExpectSameOptimumFromEveryCheckpoint(1e-6);
  for (size_t i = 1; i < checkpoints_.size(); ++i) {
    EXPECT_GE(checkpoints_[i].iterations, checkpoints_[i - 1].iterations);
    EXPECT_LE(checkpoints_[i].cost, checkpoints_[i - 1].cost);
    EXPECT_EQ(checkpoints_[i].stage, "fit");
  }
}

// The steps that would have followed, with their trust region, and not the first steps
// of a new fit.
TEST_F(ResumeTest, GoesOnWithTheSameSteps) {
  ApplySettings("nL", &scene_);
  options_.max_iterations = 12;
  FitAndKeepCheckpoints();
  const std::vector<double> expected = costs_;
  const Checkpoint checkpoint = checkpoints_[4];
  ASSERT_GT(expected.size(), checkpoint.iterations + 4);
  std::vector<double> costs(expected.size());
  EstimatorOptions options = options_;
  options.max_iterations = checkpoint.iterations + 3;
  options.progress = [&](const IterationReport& r) { costs.at(r.iteration) = r.cost; };
  EXPECT_EQ(Resume(checkpoint, options).iterations, options.max_iterations);
  for (int i = checkpoint.iterations + 1; i <= options.max_iterations; ++i) {
    EXPECT_NEAR(costs[i], expected[i], 1e-6 * expected[i]) << i;
  }
}

TEST_F(ResumeTest, WithLbfgs) {
  options_.solver = SolverType::kLbfgs;
  ExpectSameOptimumFromEveryCheckpoint(1e-4);
}

TEST_F(ResumeTest, WhileTheHorizonGrows) {
  options_.horizon = Horizon::kGrow;
  ExpectSameOptimumFromEveryCheckpoint(1e-6);
  int num_growing = 0;
  for (const Checkpoint& checkpoint : checkpoints_) {
    if (checkpoint.stage != "grow") continue;
    ++num_growing;
    EXPECT_LT(checkpoint.num_frames, kFrames);
    ASSERT_FALSE(checkpoint.horizons.empty());
    EXPECT_EQ(checkpoint.horizons.back().num_frames, checkpoint.num_frames);
  }
  EXPECT_GT(num_growing, 3);
}

TEST_F(ResumeTest, AFitThatIsOverWhileItGrowsIsContinuedThere) {
  constexpr int kLongFrames = 60;
  ApplySettings("nL", &scene_);
  scene_.objects[0].estimate_damping = false;
  target_ = test::OwnMotion(scene_, kLongFrames);
  options_.horizon = Horizon::kGrow;
  EstimatorOptions options = options_;
  // In the second horizon, after its first step.
  options.progress = [&](const IterationReport& report) {
    const bool is_first_horizon = report.num_frames == 6;
    if (report.step_accepted && !is_first_horizon && options.max_iterations < 0) {
      options.max_iterations = report.iteration;
    }
  };
  const EstimatorSummary expected = Estimate(scene_, target_, options);
  ASSERT_TRUE(expected.usable()) << expected.message;
  ASSERT_GT(expected.horizons.size(), 1u);
  options.progress = nullptr;
  options.checkpoint_path = path_;
  EXPECT_EQ(Estimate(scene_, target_, options).termination,
            Termination::kMaxIterations);
  const Checkpoint checkpoint = ReadCheckpoint(path_);
  EXPECT_EQ(checkpoint.stage, "grow");
  EXPECT_EQ(checkpoint.num_frames, expected.horizons[1].num_frames);
  EXPECT_EQ(checkpoint.iterations, options.max_iterations);
  const EstimatorSummary resumed = Resume(checkpoint, options_);
  EXPECT_TRUE(resumed.usable()) << resumed.message;
  EXPECT_LT((resumed.parameters - expected.parameters).norm(),
            1e-5 * expected.parameters.norm());
  ASSERT_EQ(resumed.horizons.size(), expected.horizons.size());
  for (size_t k = 0; k < expected.horizons.size(); ++k) {
    EXPECT_EQ(resumed.horizons[k].num_frames, expected.horizons[k].num_frames);
  }
  for (int k : {0, 1}) {
    EXPECT_EQ(resumed.horizons[k].start_rms, expected.horizons[k].start_rms);
  }
  EXPECT_EQ(resumed.horizons[0].iterations, expected.horizons[0].iterations);
}

TEST_F(ResumeTest, WithFewParametersThatAreCheckedAgainstTrialValues) {
  ApplySettings("nG", &scene_);
  scene_.objects[0].stiffness.setConstant(30.0);
  target_ = test::OwnMotion(scene_, kFrames);
  options_.uniform_value = 900.0;
  ExpectSameOptimumFromEveryCheckpoint(1e-8);
}

TEST_F(ResumeTest, AnotherFitIsRefusedAndTheDifferenceNamed) {
  FitAndKeepCheckpoints();
  const Checkpoint checkpoint = checkpoints_.back();
  const EstimatorOptions options = options_;
  options_.uniform_value = 21.0;
  EXPECT_THAT(ErrorOfResuming(checkpoint),
              AllOf(HasSubstr(path_), HasSubstr("another fit"),
                    HasSubstr("init (uniform:20 in the checkpoint, uniform:21 now)"),
                    Not(HasSubstr("scene")), Not(HasSubstr("target"))));
  options_ = options;
  options_.num_frames = kFrames - 1;
  options_.loss = LossType::kHuber;
  EXPECT_THAT(ErrorOfResuming(checkpoint),
              AllOf(HasSubstr("frames (20 in"), HasSubstr("loss (none in")));
  options_ = options;
  options_.seed = 7;
  options_.solver = SolverType::kLbfgs;
  EXPECT_THAT(ErrorOfResuming(checkpoint),
              AllOf(HasSubstr("seed (0 in"), HasSubstr("solver (auto in")));
  options_ = options;
  AddNoise(scene_, 1e-6, 1, &target_);
  EXPECT_THAT(ErrorOfResuming(checkpoint), HasSubstr("another target ("));
  target_ = test::OwnMotion(scene_, kFrames);
  scene_.objects[0].damping *= 1.0 + 1e-15;
  EXPECT_THAT(ErrorOfResuming(checkpoint), HasSubstr("another scene ("));
}

TEST_F(ResumeTest, LimitsAndThreadsMayChange) {
  FitAndKeepCheckpoints();
  options_.max_iterations = 100;
  options_.max_seconds = 1000.0;
  options_.num_threads = 2;
  options_.function_tolerance = 1e-10;
  options_.memory_limit_bytes = 0;
  EXPECT_TRUE(Resume(checkpoints_[3], options_).usable());
}

TEST_F(ResumeTest, WrongNumbersOfCoordinatesAreRefused) {
  FitAndKeepCheckpoints();
  Checkpoint checkpoint = checkpoints_.back();
  checkpoint.start = checkpoint.coordinates = Eigen::VectorXd::Zero(2);
  EXPECT_THAT(ErrorOfResuming(checkpoint),
              AllOf(HasSubstr("coordinates has 2 numbers"), HasSubstr(path_)));
}

TEST_F(ResumeTest, TimeAddsUpButTheLimitIsForEachRun) {
  FitAndKeepCheckpoints();
  Checkpoint checkpoint = checkpoints_[3];
  checkpoint.seconds = 5000.0;
  options_.max_seconds = 1000.0;
  const EstimatorSummary summary = Resume(checkpoint, options_);
  EXPECT_TRUE(summary.usable()) << summary.message;
  EXPECT_GT(summary.wall_time_s, 5000.0);
  EXPECT_LT(summary.wall_time_s, 6000.0);
}

TEST_F(ResumeTest, AFileThatCannotBeWrittenDoesNotEndTheFit) {
  const std::string lost = folder_.File("lost");
  std::filesystem::create_directory(lost);
  options_.checkpoint_path = lost + "/fit.json";
  options_.progress = [&](const IterationReport&) {
    std::filesystem::remove_all(lost);
  };
  const EstimatorSummary summary = Estimate(scene_, target_, options_);
  EXPECT_TRUE(summary.usable());
  EXPECT_TRUE(test::HasNote(summary, "the last checkpoint was not written"));
  EXPECT_TRUE(test::HasNote(summary, "No such file"));
  // A folder that was never there is a mistake.
  EXPECT_THROW(Estimate(scene_, target_, options_), SceneError);
}

}  // namespace
}  // namespace dpe
