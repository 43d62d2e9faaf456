// estimate_cloth is killed at random moments and continued from what it left behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "dpe/engine/cloth_builder.h"
#include "dpe/estimation/checkpoint.h"
#include "tools/estimate_cloth_support.h"

namespace dpe::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// Reads a checkpoint file over and over while it lives: it must be whole whenever there
// is one.
class Reader {
 public:
  explicit Reader(const std::string& path)
      : path_(path), thread_([this] { ReadUntilStopped(); }) {}
  ~Reader() {
    stop_ = true;
    thread_.join();
    EXPECT_EQ(error_, "");
  }

 private:
  void ReadUntilStopped() {
    while (!stop_ && error_.empty()) {
      try {
        if (std::filesystem::exists(path_)) ReadCheckpoint(path_);
      } catch (const SceneError& error) {
        error_ = error.what();
      }
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
  }

  const std::string path_;
  std::string error_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

class CheckpointKillTest : public EstimateClothTest {
 protected:
  ProgramResult RunFit(bool resume, double kill_after = 600.0) {
    std::vector<std::string> flags = flags_;
    flags.push_back("--checkpoint=" + checkpoint_);
    if (resume) flags.push_back("--resume=" + checkpoint_);
    RunProgramOptions options;
    options.timeout = kill_after;
    return Run(flags, options);
  }

  std::vector<double> Values() const {
    std::vector<double> values;
    for (const auto& block : Report().at("parameters")) {
      for (const double value : block.at("values")) values.push_back(value);
    }
    return values;
  }

  // The run that is under way has come to the same end as one that nobody disturbed.
  void ExpectOptimum(const ProgramResult& result, const std::vector<double>& expected) {
    ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
    const std::vector<double> values = Values();
    ASSERT_EQ(values.size(), expected.size());
    for (size_t i = 0; i < values.size(); ++i) {
      EXPECT_NEAR(values[i], expected[i], 1e-5 * std::abs(expected[i])) << i;
    }
  }

  // Kills it `num_kills` times, continues each time, and lets it come to its end.
  void KillAndResume(int num_kills) {
    const ProgramResult whole = RunFit(/*resume=*/false);
    ASSERT_EQ(whole.exit_code, 0) << whole.out << whole.err;
    const std::vector<double> expected = Values();
    std::filesystem::remove(checkpoint_);
    const Reader reader(checkpoint_);
    std::mt19937 generator(1);
    std::uniform_real_distribution<double> moment(0.0, 0.5 * whole.seconds);
    int kills = 0, resumes = 0, iterations = 0;
    while (kills < num_kills) {
      const bool resume = std::filesystem::exists(checkpoint_);
      resumes += resume;
      const ProgramResult result = RunFit(resume, moment(generator));
      if (result.exit_code != -SIGKILL) {  // it was faster
        ExpectOptimum(result, expected);
        std::filesystem::remove(checkpoint_);
        iterations = 0;
        continue;
      }
      ++kills;
      if (!std::filesystem::exists(checkpoint_)) continue;
      const Checkpoint left = ReadCheckpoint(checkpoint_);
      EXPECT_GE(left.iterations, iterations);
      iterations = left.iterations;
    }
    EXPECT_GT(resumes, num_kills / 2);
    ExpectOptimum(RunFit(std::filesystem::exists(checkpoint_)), expected);
  }

  const std::string checkpoint_ = folder_.File("fit.json");
  std::vector<std::string> flags_ = {"--init=uniform:10", "--frames=60"};
};

TEST_F(CheckpointKillTest, TwentyKillsAndResumesReachTheSameOptimum) {
  KillAndResume(20);
}

// Iterations of a hundredth of a second, most of them at horizons that grow.
TEST_F(CheckpointKillTest, LongTwentyKillsOfAFitOfManySeconds) {
  PresetOptions preset;
  preset.rows = preset.cols = 12;
  scene_ = MakePresetScene(ScenePreset::kFlag, preset);
  ApplySettings("nL", &scene_);
  SaveScene(scene_, path_);
  KillAndResume(20);
}

TEST_F(CheckpointKillTest, BadCheckpointsAreRefusedWithExitCodeOne) {
  flags_.push_back("--max_iterations=3");
  EXPECT_EQ(RunFit(/*resume=*/false).exit_code, 2);
  const std::string text = ReadFile(checkpoint_);
  const auto refused = [&](const std::string& content) {
    WriteFile(checkpoint_, content);
    const ProgramResult result = RunFit(/*resume=*/true);
    EXPECT_EQ(result.exit_code, 1) << result.out;
    EXPECT_EQ(ReadFile(checkpoint_), content);
    return result.err;
  };
  EXPECT_THAT(refused(text.substr(0, text.size() / 2)),
              AllOf(HasSubstr(checkpoint_), HasSubstr("only part of one")));
  EXPECT_THAT(refused("garbage"), HasSubstr("is not a checkpoint"));
  EXPECT_THAT(refused(""), HasSubstr("is not a checkpoint"));
  std::string other = text;
  other.replace(other.find("\"version\": 1"), 12, "\"version\": 9");
  EXPECT_THAT(refused(other), HasSubstr("version 9"));
  flags_.push_back("--frames=10");
  EXPECT_THAT(refused(text), AllOf(HasSubstr("another fit"), HasSubstr("frames (60")));
  std::filesystem::remove(checkpoint_);
  EXPECT_THAT(RunFit(/*resume=*/true).err,
              AllOf(HasSubstr(checkpoint_), HasSubstr("No such file")));
}

}  // namespace
}  // namespace dpe::test
