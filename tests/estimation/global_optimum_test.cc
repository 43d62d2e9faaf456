// One unknown value for a cloth whose true values differ: the fit must find the global
// optimum, which an independent scan over the value shows, from wherever it starts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "dpe/engine/cloth_builder.h"
#include "dpe/estimation/estimator.h"
#include "estimation/fit_support.h"

namespace dpe {
namespace {

struct Case {
  const char* preset;
  const char* settings;
  int num_frames;
};

// The least RMS over one parameter: a log-spaced scan, then golden sections around each
// of the best few local minima of the scan.
class Scan {
 public:
  Scan(const Scene& scene, const Observations& target, int num_frames)
      : simulator_(scene), target_(target), num_frames_(num_frames) {}

  double LeastRms() {
    constexpr int kPerDecade = 10;
    std::vector<double> rms;
    for (int i = -4 * kPerDecade; i <= 4 * kPerDecade; ++i) {
      rms.push_back(Rms(std::pow(10.0, static_cast<double>(i) / kPerDecade)));
    }
    std::vector<std::pair<double, int>> minima;
    for (int i = 1; i + 1 < static_cast<int>(rms.size()); ++i) {
      if (rms[i] <= rms[i - 1] && rms[i] <= rms[i + 1]) minima.emplace_back(rms[i], i);
    }
    std::sort(minima.begin(), minima.end());
    if (minima.size() > 3) minima.resize(3);
    double least = *std::min_element(rms.begin(), rms.end());
    for (const auto& [value, i] : minima) {
      const double exponent = static_cast<double>(i) / kPerDecade - 4.0;
      least = std::min(least, GoldenSection(exponent - 1.0 / kPerDecade,
                                            exponent + 1.0 / kPerDecade));
    }
    return least;
  }

 private:
  double Rms(double value) {
    const Rollout rollout =
        simulator_.Run(Eigen::VectorXd::Constant(1, value), num_frames_);
    if (!rollout.status().ok()) return std::numeric_limits<double>::infinity();
    return RmsPositionError(rollout.trajectory(), target_, num_frames_);
  }

  double GoldenSection(double low, double high) {
    constexpr double kRatio = 0.6180339887498949;
    double a = high - kRatio * (high - low), b = low + kRatio * (high - low);
    double at_a = Rms(std::pow(10.0, a)), at_b = Rms(std::pow(10.0, b));
    for (int i = 0; i < 15; ++i) {
      if (at_a < at_b) {
        high = b;
        b = a;
        at_b = at_a;
        a = high - kRatio * (high - low);
        at_a = Rms(std::pow(10.0, a));
      } else {
        low = a;
        a = b;
        at_a = at_b;
        b = low + kRatio * (high - low);
        at_b = Rms(std::pow(10.0, b));
      }
    }
    return std::min(at_a, at_b);
  }

  Simulator simulator_;
  Observations target_;
  int num_frames_;
};

class GlobalOptimumTest : public ::testing::TestWithParam<Case> {};

TEST_P(GlobalOptimumTest, IsFoundFromAnyStart) {
  const auto [preset, settings, num_frames] = GetParam();
  Scene scene = MakePresetScene(ScenePresetFromName(preset));
  ApplySettings(settings, &scene);
  const Observations target = test::OwnMotion(scene, num_frames);
  const double least = Scan(scene, target, num_frames).LeastRms();
  EstimatorOptions options;
  for (const double start : {1.0, 1e-4, 0.0}) {
    options.init = start > 0.0 ? InitMethod::kUniform : InitMethod::kAuto;
    options.uniform_value = start;
    const EstimatorSummary summary = Estimate(scene, target, options);
    EXPECT_EQ(summary.termination, Termination::kConverged) << summary.message;
    EXPECT_LE(summary.final_rms, 1.001 * least) << "start " << start;
    // The scan is fine enough to be a reference.
    EXPECT_GE(summary.final_rms, 0.999 * least) << "start " << start;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Presets, GlobalOptimumTest,
    ::testing::Values(Case{"side", "Gn", 100}, Case{"side", "nG", 100},
                      Case{"corners", "Gn", 100}, Case{"corners", "nG", 100},
                      Case{"flag", "Gn", 20}, Case{"flag", "nG", 20},
                      Case{"flag_no_wind", "Gn", 20}, Case{"flag_no_wind", "nG", 20}),
    [](const auto& info) {
      return std::string(info.param.preset) + "_" + info.param.settings;
    });

// Mass and stiffness of the flag in its wind: a valley with a minimum at 10 N/m and a
// lower one at 55 N/m, between which the RMS is a tenth higher.
TEST(GlobalOptimumOfTwoTest, IsFoundAlongAValley) {
  constexpr int kFrames = 100;
  Scene scene = MakePresetScene(ScenePreset::kFlag);
  ApplySettings("GG", &scene);
  const Observations target = test::OwnMotion(scene, kFrames);
  Simulator simulator(scene);
  // The least over the part of a grid with this stiffness or more, or less.
  const auto least_rms = [&](double low, double high) {
    double least = std::numeric_limits<double>::infinity();
    for (double k = low; k < high; k *= 1.1) {
      for (double m = 0.032; m < 0.042; m *= 1.02) {
        const Rollout rollout = simulator.Run(Eigen::Vector2d(m, k), kFrames);
        if (!rollout.status().ok()) continue;
        least =
            std::min(least, RmsPositionError(rollout.trajectory(), target, kFrames));
      }
    }
    return least;
  };
  const double lower = least_rms(45.0, 70.0), higher = least_rms(8.0, 13.0);
  ASSERT_LT(lower, higher);
  EstimatorOptions options;
  options.init = InitMethod::kUniform;
  options.uniform_value = 10.0;
  const EstimatorSummary summary = Estimate(scene, target, options);
  EXPECT_EQ(summary.termination, Termination::kConverged) << summary.message;
  EXPECT_LE(summary.final_rms, lower);
  EXPECT_TRUE(test::HasNote(summary, "along the valley"));
  options.max_checked_parameters = 0;
  EXPECT_GT(Estimate(scene, target, options).final_rms, lower);
}

}  // namespace
}  // namespace dpe
