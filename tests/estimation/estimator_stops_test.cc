// How a fit ends when it does not simply converge, and what it refuses to begin.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>

#include "dpe/estimation/estimator.h"
#include "estimation/fit_support.h"
#include "support/test_scenes.h"

namespace dpe {
namespace {

using ::testing::HasSubstr;

constexpr int kFrames = 20;

class EstimatorStopsTest : public ::testing::Test {
 protected:
  EstimatorStopsTest() {
    scene_ = test::MakeDerivativeScene("side", 5);
    test::Perturb(2, &scene_);
    ApplySettings("nL", &scene_);
    target_ = test::OwnMotion(scene_, kFrames);
    options_.init = InitMethod::kUniform;
    options_.uniform_value = 20.0;
  }

  // An explicit step that some stiffnesses are too much for.
  void MakeExplicit() {
    scene_.integration_method = IntegrationMethod::kSymplecticEuler;
    target_ = test::OwnMotion(scene_, kFrames);
    ASSERT_TRUE(target_.positions[0].allFinite());
  }

  std::string ErrorOf() {
    try {
      Estimate(scene_, target_, options_);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "accepted";
  }

  Scene scene_;
  Observations target_;
  EstimatorOptions options_;
};

TEST_F(EstimatorStopsTest, AStartThatCannotBeSimulatedIsReportedAndScreenHelps) {
  MakeExplicit();
  options_.uniform_value = 1e7;
  options_.horizon = Horizon::kFull;
  const EstimatorSummary failed = Estimate(scene_, target_, options_);
  EXPECT_EQ(failed.termination, Termination::kStartFailed);
  EXPECT_FALSE(failed.usable());
  EXPECT_THAT(failed.message, HasSubstr("starting point (uniform)"));
  EXPECT_THAT(failed.message, HasSubstr("--init=screen"));
  EXPECT_TRUE(std::isnan(failed.final_rms));
  options_.init = InitMethod::kScreen;
  const EstimatorSummary screened = Estimate(scene_, target_, options_);
  EXPECT_NE(screened.termination, Termination::kStartFailed);
  EXPECT_LT(screened.final_rms, 1e-3);
  // One value for all elements is looked for over few frames, and found.
  options_.init = InitMethod::kUniform;
  options_.horizon = Horizon::kAuto;
  EXPECT_LT(Estimate(scene_, target_, options_).final_rms, 1e-3);
}

TEST_F(EstimatorStopsTest, AFailedStartOfOneParameterIsReplacedByTheScreens) {
  MakeExplicit();
  ApplySettings("nG", &scene_);
  options_.uniform_value = 1e7;
  options_.horizon = Horizon::kFull;
  const EstimatorSummary summary = Estimate(scene_, target_, options_);
  EXPECT_EQ(summary.termination, Termination::kConverged) << summary.message;
  EXPECT_EQ(summary.init, "screen");
  EXPECT_TRUE(test::HasNote(summary, "cannot be simulated"));
  options_.max_checked_parameters = 0;
  EXPECT_EQ(Estimate(scene_, target_, options_).termination, Termination::kStartFailed);
  // Over a few frames it can be simulated, and from there it finds its way.
  options_.horizon = Horizon::kAuto;
  EXPECT_EQ(Estimate(scene_, target_, options_).termination, Termination::kConverged);
}

// What has been found over fewer frames is not lost when time is up before all frames
// have been looked at.
TEST_F(EstimatorStopsTest, StoppedWhileItGrowsOrShootsItKeepsWhatItFound) {
  for (const Horizon horizon : {Horizon::kGrow, Horizon::kShooting}) {
    int num_reports = 0;
    options_.horizon = horizon;
    options_.progress = [&](const IterationReport&) { ++num_reports; };
    options_.interrupted = [&] { return num_reports >= 10; };
    const EstimatorSummary summary = Estimate(scene_, target_, options_);
    EXPECT_EQ(summary.termination, Termination::kInterrupted);
    EXPECT_LT(summary.final_rms, 0.5 * summary.initial_rms) << num_reports;
  }
}

TEST_F(EstimatorStopsTest, IterationLimit) {
  options_.max_iterations = 2;
  const EstimatorSummary summary = Estimate(scene_, target_, options_);
  EXPECT_EQ(summary.termination, Termination::kMaxIterations);
  EXPECT_EQ(summary.iterations, 2);
  EXPECT_FALSE(summary.usable());
  EXPECT_LE(summary.final_cost, summary.initial_cost);
  EXPECT_NEAR(test::RmsOfScene(summary.scene, target_, kFrames), summary.final_rms,
              1e-12 * summary.final_rms);
}

TEST_F(EstimatorStopsTest, TimeLimit) {
  options_.max_seconds = 0.05;
  options_.progress = [&](const IterationReport&) {
    const auto begin = std::chrono::steady_clock::now();
    while (std::chrono::steady_clock::now() - begin < std::chrono::milliseconds(30)) {
    }
  };
  const EstimatorSummary summary = Estimate(scene_, target_, options_);
  EXPECT_EQ(summary.termination, Termination::kMaxSeconds) << summary.message;
  EXPECT_LE(summary.final_cost, summary.initial_cost);
}

TEST_F(EstimatorStopsTest, InterruptionKeepsTheBestSoFar) {
  for (const SolverType solver :
       {SolverType::kLevenbergMarquardt, SolverType::kLbfgs}) {
    options_.solver = solver;
    int iterations = 0;
    options_.progress = [&](const IterationReport& r) { iterations = r.iteration; };
    options_.interrupted = [&] { return iterations >= 3; };
    const EstimatorSummary summary = Estimate(scene_, target_, options_);
    EXPECT_EQ(summary.termination, Termination::kInterrupted) << summary.message;
    EXPECT_LE(summary.final_cost, summary.initial_cost);
    EXPECT_NEAR(test::RmsOfScene(summary.scene, target_, kFrames), summary.final_rms,
                1e-12 * summary.final_rms);
  }
}

TEST_F(EstimatorStopsTest, InterruptionBeforeTheStartIsSimulated) {
  options_.interrupted = [] { return true; };
  const EstimatorSummary summary = Estimate(scene_, target_, options_);
  EXPECT_EQ(summary.termination, Termination::kInterrupted);
  EXPECT_TRUE(std::isnan(summary.final_cost));
}

// Rollouts, derivative passes and the reduction of the Jacobian all ask, and none goes
// on when the answer is yes. So does a time limit end a fit within a step.
TEST_F(EstimatorStopsTest, NothingGoesOnForLongAfterAnInterruption) {
  for (const SolverType solver :
       {SolverType::kLevenbergMarquardt, SolverType::kLbfgs}) {
    options_.solver = solver;
    options_.max_iterations = 6;
    options_.uncertainty = UncertaintyMode::kOff;  // it is no part of the fit
    options_.horizon = Horizon::kFull;
    long polls = 0, last = 1L << 40;
    options_.interrupted = [&] { return ++polls > last; };
    const EstimatorSummary whole = Estimate(scene_, target_, options_);
    const long all = polls;
    const long steps = kFrames - 1;
    EXPECT_GE(all, (whole.evaluations + whole.jacobian_evaluations) * steps);
    for (int k = 1; k < 40; ++k) {
      polls = 0;
      last = all * k / 40;
      const EstimatorSummary summary = Estimate(scene_, target_, options_);
      EXPECT_EQ(summary.termination, Termination::kInterrupted) << k;
      // Every part that is under way asks once more; the optimiser may try another.
      EXPECT_LE(polls, last + 20) << k;
    }
  }
}

TEST_F(EstimatorStopsTest, SolverChoiceIsExplained) {
  options_.max_iterations = 0;
  EXPECT_EQ(Estimate(scene_, target_, options_).solver, "lm");
  options_.max_lm_jacobian_bytes = 1000.0;
  const EstimatorSummary summary = Estimate(scene_, target_, options_);
  EXPECT_EQ(summary.solver, "lbfgs");
  EXPECT_EQ(summary.jacobian, "gradient");
  EXPECT_THAT(summary.solver_reason, HasSubstr("above the limit"));
}

TEST_F(EstimatorStopsTest, BadInputIsRefused) {
  options_.num_frames = kFrames + 1;
  EXPECT_THAT(ErrorOf(), HasSubstr("21 asked for, 20 observed"));
  options_.num_frames = 1;
  EXPECT_THAT(ErrorOf(), HasSubstr("2 or more"));
  options_.num_frames = 0;
  target_.positions[0].setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_THAT(ErrorOf(), HasSubstr("no free vertex"));
  options_.init = InitMethod::kInverseDynamics;
  target_ = test::OwnMotion(scene_, kFrames);
  target_.positions[0](0, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(ErrorOf(), HasSubstr("every free vertex"));
  ApplySettings("nn", &scene_);
  EXPECT_THAT(ErrorOf(), HasSubstr("nothing is estimated"));
}

}  // namespace
}  // namespace dpe
