// Whole fits to several captures of one cloth.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "dpe/engine/cloth_builder.h"
#include "dpe/estimation/checkpoint.h"
#include "dpe/estimation/estimator.h"
#include "dpe/estimation/joint_layout.h"
#include "estimation/fit_support.h"
#include "estimation/segment_support.h"
#include "support/temp_dir.h"

namespace dpe {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// A cloth hanging from a side and from two corners, each seen completely in its own
// number of frames.
std::vector<CapturedMotion> TwoCaptures(const std::string& settings, int num_frames) {
  std::vector<CapturedMotion> captures;
  for (Scene& scene : test::SideAndCorners()) {
    ApplySettings(settings, &scene);
    const int frames = num_frames + 3 * static_cast<int>(captures.size());
    Observations seen = test::OwnMotion(scene, frames);
    captures.push_back({std::move(scene), std::move(seen), ""});
  }
  return captures;
}

std::vector<const Scene*> Truths(const std::vector<CapturedMotion>& captures) {
  std::vector<const Scene*> truths;
  for (const CapturedMotion& capture : captures) truths.push_back(&capture.scene);
  return truths;
}

// Only every other vertex was seen.
void HideHalf(Observations* observations) {
  Eigen::MatrixXd& positions = observations->positions[0];
  for (int v = 0; v < positions.rows() / 3; v += 2) {
    positions.middleRows(3 * v, 3).rightCols(positions.cols() - 1).setConstant(kNan);
  }
}

std::string ErrorOf(const std::vector<CapturedMotion>& captures,
                    const EstimatorOptions& options = {}) {
  try {
    Estimate(captures, options);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(SeveralCaptures, AListOfOneIsThatOneBitByBit) {
  const CapturedMotion capture = TwoCaptures("nL", 20)[0];
  EstimatorOptions options;
  options.init = InitMethod::kUniform;
  options.uniform_value = 10.0;
  options.max_iterations = 12;
  const EstimatorSummary alone = Estimate(capture.scene, capture.observations, options);
  const EstimatorSummary listed = Estimate({capture}, options);
  EXPECT_GT(alone.iterations, 3);
  EXPECT_EQ(alone.parameters, listed.parameters);
  EXPECT_EQ(alone.final_cost, listed.final_cost);
  ASSERT_EQ(alone.captures.size(), 1u);
  EXPECT_EQ(alone.captures[0].final_rms, alone.final_rms);
  EXPECT_EQ(alone.blocks[0].capture, -1);
}

// Springs and vertices that one capture holds fixed are what the other says.
TEST(SeveralCaptures, TogetherTheyDetermineWhatEachLeavesOpen) {
  const std::vector<CapturedMotion> captures = TwoCaptures("nL", 30);
  const EstimatorSummary summary = Estimate(captures, EstimatorOptions());
  ASSERT_TRUE(summary.usable()) << summary.message;
  EXPECT_EQ(summary.init, "inverse_dynamics");
  EXPECT_LT(summary.final_rms, 1e-9);
  EXPECT_LT(ParameterDeviationPercent(summary, Truths(captures)), 1e-3);
  EXPECT_EQ(summary.num_frames, 33);
  ASSERT_EQ(summary.captures.size(), 2u);
  const EstimatorSummary alone =
      Estimate(captures[0].scene, captures[0].observations, EstimatorOptions());
  EXPECT_LT(alone.parameters.size(), summary.parameters.size());
  for (int c = 0; c < 2; ++c) {
    const CaptureSummary& capture = summary.captures[c];
    EXPECT_EQ(capture.num_frames, 30 + 3 * c);
    EXPECT_LT(capture.final_rms, 1e-9);
    EXPECT_NEAR(
        test::RmsOfScene(capture.scene, captures[c].observations, capture.num_frames),
        capture.final_rms, 1e-12);
    // One cloth: also where a spring has no influence.
    EXPECT_LT(
        (capture.scene.objects[0].stiffness - captures[1].scene.objects[0].stiffness)
            .lpNorm<Eigen::Infinity>(),
        1e-4 * captures[1].scene.objects[0].stiffness.maxCoeff());
  }
}

TEST(SeveralCaptures, InverseDynamicsOfAllIsExact) {
  std::vector<CapturedMotion> captures = TwoCaptures("nL", 12);
  captures[1].scene.steps_per_frame = 1;
  captures[1].observations = test::OwnMotion(captures[1].scene, 12);
  EstimatorOptions options;
  options.max_iterations = 0;
  const EstimatorSummary summary = Estimate(captures, options);
  EXPECT_EQ(summary.init, "inverse_dynamics");
  EXPECT_LT(summary.initial_rms, 1e-10);
  EXPECT_LT(ParameterDeviationPercent(summary, Truths(captures)), 1e-5);
}

TEST(SeveralCaptures, InverseDynamicsIsOfThoseThatAreComplete) {
  std::vector<CapturedMotion> captures = TwoCaptures("nL", 20);
  captures[1].scene.objects[0].estimate_initial_velocity = true;
  HideHalf(&captures[1].observations);
  const EstimatorSummary summary = Estimate(captures, EstimatorOptions());
  ASSERT_TRUE(summary.usable()) << summary.message;
  EXPECT_EQ(summary.init, "inverse_dynamics");
  EXPECT_TRUE(test::HasNote(summary, "of those 1 of 2 captures"));
  // Half of it is news: the start is a start only.
  EXPECT_FALSE(summary.horizons.empty());
  EXPECT_LT(summary.final_rms, 1e-6);
  HideHalf(&captures[0].observations);
  EstimatorOptions options;
  options.init = InitMethod::kInverseDynamics;
  EXPECT_THAT(ErrorOf(captures, options), HasSubstr("inverse dynamics needs"));
}

TEST(SeveralCaptures, WindAndInitialVelocityAreEachOnesOwn) {
  std::vector<CapturedMotion> captures = TwoCaptures("nG", 30);
  for (CapturedMotion& capture : captures) {
    capture.scene.objects[0].stiffness.setConstant(40.0);
    capture.scene.estimate_wind = true;
  }
  captures[1].scene.objects[0].estimate_initial_velocity = true;
  ASSERT_GT((captures[0].scene.wind - captures[1].scene.wind).norm(), 0.5);
  for (CapturedMotion& capture : captures) {
    capture.observations = test::OwnMotion(capture.scene, 30);
  }
  const EstimatorSummary summary = Estimate(captures, EstimatorOptions());
  ASSERT_TRUE(summary.usable()) << summary.message;
  EXPECT_LT(summary.final_rms, 1e-8);
  ASSERT_EQ(summary.blocks.size(), 4u);
  EXPECT_EQ(summary.blocks[0].capture, -1);
  EXPECT_NEAR(summary.blocks[0].values[0], 40.0, 1e-3);
  for (int c = 0; c < 2; ++c) {
    const Scene& fitted = summary.captures[c].scene;
    EXPECT_LT((fitted.wind - captures[c].scene.wind).norm(), 1e-4);
    EXPECT_LT(
        (fitted.objects[0].velocities - captures[c].scene.objects[0].velocities).norm(),
        1e-4);
  }
  int num_own = 0;
  for (const EstimatedBlock& block : summary.blocks) num_own += block.capture == 1;
  EXPECT_EQ(num_own, 2);
}

TEST(SeveralCaptures, ResultsDoNotDependOnThreads) {
  std::vector<CapturedMotion> captures = TwoCaptures("nL", 20);
  for (int c = 0; c < 2; ++c) {
    AddNoise(captures[c].scene, 1e-3, 7 + c, &captures[c].observations);
    captures[c].observations.sigma = 1e-3;
  }
  EstimatorOptions options;
  options.init = InitMethod::kUniform;
  options.uniform_value = 10.0;
  options.max_iterations = 10;
  const EstimatorSummary one = Estimate(captures, options);
  for (const int threads : {2, 4}) {
    options.num_threads = threads;
    const EstimatorSummary several = Estimate(captures, options);
    EXPECT_EQ(one.parameters, several.parameters) << threads;
    EXPECT_EQ(one.final_cost, several.final_cost) << threads;
    EXPECT_EQ(one.iterations, several.iterations) << threads;
    EXPECT_EQ(one.uncertainty.covariance, several.uncertainty.covariance) << threads;
  }
}

TEST(SeveralCaptures, TheHorizonGrowsOverAllAndShortOnesAreCompleteEarlier) {
  std::vector<CapturedMotion> captures = TwoCaptures("nL", 60);
  captures[0].observations = test::OwnMotion(captures[0].scene, 14);
  EstimatorOptions options;
  options.init = InitMethod::kUniform;
  options.uniform_value = 20.0;
  std::vector<int> frames;
  options.progress = [&](const IterationReport& r) { frames.push_back(r.num_frames); };
  const EstimatorSummary summary = Estimate(captures, options);
  ASSERT_TRUE(summary.usable()) << summary.message;
  EXPECT_LT(summary.final_rms, 1e-8);
  EXPECT_LT(ParameterDeviationPercent(summary, Truths(captures)), 1e-2);
  ASSERT_GT(summary.horizons.size(), 2u);
  EXPECT_EQ(summary.horizons[0].num_frames, 6);
  EXPECT_GT(summary.horizons.back().num_frames, 14);
  EXPECT_EQ(summary.captures[0].num_frames, 14);
  EXPECT_EQ(summary.captures[1].num_frames, 63);
}

// A horizon may end before one of the captures shows anything.
TEST(SeveralCaptures, OneMayBeginToBeSeenLate) {
  std::vector<CapturedMotion> captures = TwoCaptures("nL", 40);
  captures[1].observations.positions[0].leftCols(20).setConstant(kNan);
  EstimatorOptions options;
  options.init = InitMethod::kUniform;
  options.uniform_value = 20.0;
  for (const SolverType solver :
       {SolverType::kLevenbergMarquardt, SolverType::kLbfgs}) {
    options.solver = solver;
    options.horizon = Horizon::kGrow;
    options.max_iterations = solver == SolverType::kLbfgs ? 400 : -1;
    const EstimatorSummary summary = Estimate(captures, options);
    ASSERT_FALSE(summary.horizons.empty());
    EXPECT_EQ(summary.horizons[0].num_frames, 6);
    EXPECT_LT(summary.final_rms, 0.1 * summary.horizons[0].start_rms);
    if (solver == SolverType::kLbfgs) continue;
    EXPECT_TRUE(summary.usable()) << summary.message;
    EXPECT_LT(ParameterDeviationPercent(summary, Truths(captures)), 1e-2);
  }
}

TEST(SeveralCaptures, AsManyFramesAreFittedAsEachHas) {
  std::vector<CapturedMotion> captures = TwoCaptures("nG", 10);
  EstimatorOptions options;
  options.num_frames = 12;
  const EstimatorSummary summary = Estimate(captures, options);
  EXPECT_EQ(summary.num_frames, 12);
  EXPECT_EQ(summary.captures[0].num_frames, 10);
  EXPECT_EQ(summary.captures[1].num_frames, 12);
  options.num_frames = 14;
  EXPECT_THAT(ErrorOf(captures, options),
              AllOf(HasSubstr("capture 1: "), HasSubstr("14 asked for, 10 observed")));
}

TEST(SeveralCaptures, AKnownForceInOneFixesTheScaleForAll) {
  std::vector<CapturedMotion> captures = TwoCaptures("LL", 20);
  for (CapturedMotion& capture : captures) {
    capture.scene.objects[0].drag_coefficient = 0.0;
    capture.observations = test::OwnMotion(capture.scene, 20);
  }
  const std::string kKept = "no known force fixes the scale";
  EstimatorSummary summary = Estimate(captures, EstimatorOptions());
  ASSERT_TRUE(summary.usable()) << summary.message;
  EXPECT_TRUE(test::HasNote(summary, kKept));
  // The mass that is kept is that of the vertices that are free in either.
  EXPECT_LT(ParameterDeviationPercent(summary, Truths(captures)), 1e-3);

  captures[1].scene.objects[0].mass *= 1.01;
  EXPECT_THAT(ErrorOf(captures), AllOf(HasSubstr("capture 1 and capture 2 give two"),
                                       HasSubstr("accepted are equal ones")));
  captures[1].scene.objects[0].mass /= 1.01;

  // Something stiff that the second one falls onto.
  Collider ball;
  ball.position = captures[1].scene.objects[0].positions.segment<3>(3 * 5);
  ball.position.y() -= 0.6;
  captures[1].scene.colliders.push_back(ball);
  captures[1].observations = test::OwnMotion(captures[1].scene, 20);
  EstimatorOptions options;
  options.init = InitMethod::kScene;
  options.max_iterations = 0;
  EXPECT_FALSE(test::HasNote(Estimate(captures, options), kKept));
}

TEST(SeveralCaptures, WhatDoesNotBelongTogetherIsRefused) {
  const std::vector<CapturedMotion> good = TwoCaptures("nL", 10);
  struct Case {
    std::function<void(CapturedMotion*)> spoil;  // the second
    std::vector<std::string> parts;              // of the message
  };
  const Case kCases[] = {
      {[](CapturedMotion* c) {
         std::swap(c->scene.objects[0].springs[0], c->scene.objects[0].springs[1]);
       },
       {"capture 1 and b.txt are not of the same cloths",
        "objects[0].springs[0] is 0-4 in capture 1 and 0-5 in b.txt"}},
      {[](CapturedMotion* c) { c->observations.sigma = 0.01; },
       {"the noise (sigma) of b.txt is known and that of capture 1 is not"}},
      {[](CapturedMotion* c) {
         c->observations.positions[0].rightCols(12).setConstant(kNan);
       },
       {"b.txt: no free vertex of an estimated object is observed after frame 0"}},
      {[](CapturedMotion* c) {
         c->observations.positions[0].conservativeResize(Eigen::NoChange, 1);
       },
       {"b.txt: frames to fit: 1; accepted are 2 or more"}},
      {[](CapturedMotion* c) { c->scene.objects[0].mass[5] = -1.0; },
       {"b.txt", "vertMass"}},
  };
  for (const Case& c : kCases) {
    std::vector<CapturedMotion> captures = good;
    captures[1].name = "b.txt";
    c.spoil(&captures[1]);
    for (const std::string& part : c.parts) {
      EXPECT_THAT(ErrorOf(captures), HasSubstr(part));
    }
  }
  EXPECT_THAT(ErrorOf({}), HasSubstr("at least one capture"));
}

TEST(SeveralCaptures, AFitIsContinuedFromAnyCheckpoint) {
  std::vector<CapturedMotion> captures = TwoCaptures("nR", 40);  // not what made them
  const test::TempDir folder;
  const std::string path = folder.File("fit.json");
  EstimatorOptions options;
  options.init = InitMethod::kUniform;
  options.uniform_value = 20.0;
  options.horizon = Horizon::kGrow;
  options.checkpoint_path = path;
  std::vector<Checkpoint> checkpoints;
  options.progress = [&](const IterationReport&) {
    if (std::filesystem::exists(path)) checkpoints.push_back(ReadCheckpoint(path));
  };
  const EstimatorSummary expected = Estimate(captures, options);
  ASSERT_TRUE(expected.usable()) << expected.message;
  ASSERT_GT(checkpoints.size(), 4u);
  options.progress = nullptr;
  options.checkpoint_path.clear();
  options.resume_path = path;
  for (const Checkpoint& checkpoint : checkpoints) {
    WriteCheckpoint(checkpoint, path);
    const EstimatorSummary resumed = Estimate(captures, options);
    EXPECT_TRUE(resumed.usable()) << resumed.message;
    EXPECT_LT((resumed.parameters - expected.parameters).norm(),
              1e-6 * expected.parameters.norm())
        << checkpoint.stage << " " << checkpoint.iterations;
    EXPECT_EQ(resumed.initial_cost, expected.initial_cost);
  }
  // Of the second capture alone, with another target, and in the other order.
  EXPECT_THAT(ErrorOf({captures[1]}, options),
              AllOf(HasSubstr("another fit"), HasSubstr("target 2 (")));
  AddNoise(captures[1].scene, 1e-9, 1, &captures[1].observations);
  EXPECT_THAT(ErrorOf(captures, options), HasSubstr("with another target 2 ("));
  std::swap(captures[0], captures[1]);
  EXPECT_THAT(ErrorOf(captures, options),
              AllOf(HasSubstr("scene 1 ("), HasSubstr("scene 2 (")));
}

TEST(SeveralCaptures, TheTruthIsKnownWhereOneValueCanSayIt) {
  std::vector<CapturedMotion> captures = TwoCaptures("GR", 10);
  Scene& first = captures[0].scene;
  first.objects[0].mass.setConstant(0.1);
  first.objects[0].stiffness.setConstant(20.0);
  captures[1].scene.objects[0].mass = first.objects[0].mass;
  captures[1].scene.objects[0].stiffness = first.objects[0].stiffness;
  EXPECT_EQ(TrueParametersOf(Truths(captures)).is_known, std::vector<char>({1, 1}));
  // Another value in a scene that contradicts the first's.
  captures[1].scene.objects[0].mass.setConstant(0.2);
  EXPECT_EQ(TrueParametersOf(Truths(captures)).is_known, std::vector<char>({0, 1}));
}

}  // namespace
}  // namespace dpe
