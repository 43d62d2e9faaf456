// Which model is chosen for which truth, and how the choice ends when it cannot be
// made.
#include "dpe/estimation/model_selection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <numeric>
#include <random>

#include "dpe/engine/cloth_builder.h"
#include "estimation/fit_support.h"
#include "forecast.h"
#include "support/test_scenes.h"

namespace dpe {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr int kFrames = 30;
constexpr double kSigma = 0.005;  // m

// A cloth whose stiffness is one value, one per kind of spring, or a smooth field over
// the one value: a truth of mode G, R or L.
Scene Truth(char mode, int resolution = 6, unsigned seed = 1) {
  Scene scene = test::MakeDerivativeScene("side", resolution);
  ApplySettings(mode == 'R' ? "nR" : "nG", &scene);
  const ParameterLayout layout(scene);
  layout.Insert(layout.Extract(scene), &scene);
  if (mode == 'L') {
    MaterialVariation variation;
    variation.stiffness_sigma = 1.0;
    variation.seed = seed;
    VaryMaterial(variation, &scene.objects[0]);
  }
  ApplySettings("nG", &scene);
  return scene;
}

// Noise on every coordinate; only `num_markers` vertices are seen.
Observations Capture(const Scene& truth, int num_frames, int num_markers, int seed) {
  Observations capture = test::OwnMotion(truth, num_frames);
  AddNoise(truth, kSigma, seed, &capture);
  std::vector<int> unseen(truth.objects[0].num_vertices());
  std::iota(unseen.begin(), unseen.end(), 0);
  std::shuffle(unseen.begin(), unseen.end(), std::mt19937(seed));
  unseen.resize(unseen.size() - num_markers);
  for (const int v : unseen) {
    capture.positions[0]
        .middleRows<3>(3 * v)
        .rightCols(num_frames - 1)
        .setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return capture;
}

SelectedModel Select(const Scene& scene, const Observations& target,
                     const EstimatorOptions& options = {}) {
  ModelSelectionOptions selection;
  for (size_t i = 0; i < scene.objects.size(); ++i) {
    if (scene.objects[i].stiffness_mode != ParameterMode::kFixed) {
      selection.objects.push_back(static_cast<int>(i));
    }
  }
  return SelectModel(scene, target, options, selection);
}

const ModelCandidate& Row(const SelectedModel& model, const std::string& settings) {
  static const ModelCandidate kNone;
  for (const ModelCandidate& row : model.selection.candidates) {
    if (row.settings == settings) return row;
  }
  ADD_FAILURE() << "no candidate " << settings;
  return kNone;
}

TEST(ModelSelectionTest, ExactMotionsChooseTheirTruth) {
  for (const char mode : {'G', 'R', 'L'}) {
    const Scene truth = Truth(mode);
    const Observations target = test::OwnMotion(truth, kFrames);
    // Whatever the scene says.
    const SelectedModel model =
        Select(test::WithEstimatesOverwritten(truth, 3.0), target);
    EXPECT_EQ(model.selection.chosen, std::string("n") + mode);
    EXPECT_TRUE(model.summary.usable()) << model.summary.message;
    EXPECT_EQ(model.summary.num_frames, kFrames);
    EXPECT_EQ(model.selection.num_fitted_frames, 20);
    EXPECT_LT(test::RmsOfScene(model.summary.scene, target, kFrames), 1e-9);
    EXPECT_EQ(SettingsString(model.summary.scene), model.selection.chosen);
    EXPECT_THAT(model.selection.reason, HasSubstr(model.selection.chosen));
    const std::vector<ModelCandidate>& rows = model.selection.candidates;
    ASSERT_EQ(rows.size(), 3u);
    for (const ModelCandidate& row : rows) {
      // None is fitted after one that leaves nothing to explain.
      EXPECT_EQ(row.was_fitted, row.kept) << row.settings;
      EXPECT_FALSE(row.reason.empty());
    }
    if (mode == 'G') {
      EXPECT_THAT(rows[1].reason, HasSubstr("nothing to explain"));
    }
  }
}

// Without inverse dynamics: each candidate starts from the one before.
TEST(ModelSelectionTest, ExactMarkersOnSomeOfTheClothChooseTheirTruth) {
  for (const char mode : {'G', 'R', 'L'}) {
    const Scene truth = Truth(mode, 5);
    Observations target = test::OwnMotion(truth, kFrames);
    for (int v = 0; v < truth.objects[0].num_vertices(); v += 4) {
      target.positions[0]
          .middleRows<3>(3 * v)
          .rightCols(kFrames - 1)
          .setConstant(std::numeric_limits<double>::quiet_NaN());
    }
    const SelectedModel model =
        Select(test::WithEstimatesOverwritten(truth, 3.0), target);
    EXPECT_EQ(model.selection.chosen, std::string("n") + mode);
    EXPECT_LT(test::RmsOfScene(model.summary.scene, target, kFrames), 1e-7);
  }
}

TEST(ModelSelectionTest, NoiseAsksForNoMoreThanTheTruth) {
  const Scene uniform = Truth('G'), groups = Truth('R');
  int num_uniform = 0, num_groups = 0;
  for (int seed = 1; seed <= 10; ++seed) {
    num_uniform +=
        Select(uniform, Capture(uniform, kFrames, 12, seed)).selection.chosen == "nG";
    num_groups +=
        Select(groups, Capture(groups, kFrames, 12, seed)).selection.chosen == "nR";
  }
  EXPECT_GE(num_uniform, 9);
  EXPECT_GE(num_groups, 9);
}

TEST(ModelSelectionTest, ALargeSmoothVariationIsSeenThroughTheNoise) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const Scene truth = Truth('L', 6, seed);
    const SelectedModel model = Select(test::WithEstimatesOverwritten(truth, 3.0),
                                       Capture(truth, 60, 30, static_cast<int>(seed)));
    EXPECT_EQ(model.selection.chosen, "nL") << model.selection.reason;
    EXPECT_LT(Row(model, "nL").held_out_rms, Row(model, "nR").held_out_rms);
  }
}

// A smoothness prior is for the models that have elements.
TEST(ModelSelectionTest, SmoothnessIsOfTheModelWithElementsAlone) {
  const Scene truth = Truth('L', 6, 2);
  Observations target = Capture(truth, 60, 30, 2);
  target.sigma = kSigma;
  EstimatorOptions options;
  options.smoothness.push_back({ParameterKind::kStiffness, -1, 30.0, false});
  const SelectedModel smooth = Select(truth, target, options);
  const SelectedModel plain = Select(truth, target);
  EXPECT_EQ(smooth.selection.chosen, "nL");
  EXPECT_EQ(plain.selection.chosen, "nL");
  EXPECT_EQ(Row(smooth, "nR").held_out_rms, Row(plain, "nR").held_out_rms);
  EXPECT_NE(Row(smooth, "nL").held_out_rms, Row(plain, "nL").held_out_rms);
  EXPECT_LT(Row(smooth, "nL").held_out_rms, 0.5 * Row(smooth, "nR").held_out_rms);
  EXPECT_EQ(smooth.summary.smoothness.size(), 1u);
  EXPECT_FALSE(test::HasNote(smooth.summary, "less than 1 %"));
  EXPECT_TRUE(test::HasNote(plain.summary, "less than 1 %"));
}

// Objects that nothing couples are decided one after the other.
TEST(ModelSelectionTest, EachObjectGetsItsOwn) {
  Scene scene = Truth('G', 5);
  scene.objects.push_back(Truth('R', 5).objects[0]);
  scene.objects.push_back(scene.objects[0]);
  EXPECT_EQ(ApplyAutoSettings("auto,auto,nn", &scene), (std::vector<int>{0, 1}));
  const SelectedModel model = Select(scene, test::OwnMotion(scene, kFrames));
  EXPECT_EQ(model.selection.chosen, "nG,nR");
  EXPECT_EQ(model.selection.candidates[0].settings, "nG,nG");
  // A richer first object is no better, a richer second one is.
  EXPECT_FALSE(Row(model, "nR,nG").kept);
  EXPECT_FALSE(Row(model, "nL,nG").kept);
  EXPECT_TRUE(Row(model, "nG,nR").kept);
  EXPECT_FALSE(Row(model, "nG,nL").was_fitted);
  EXPECT_LT(model.summary.final_rms, 1e-9);
}

TEST(ModelSelectionTest, WhatIsTheSameAsTheModelBeforeIsNotTried) {
  Scene scene = Truth('L', 5);
  scene.objects[0].spring_group.assign(scene.objects[0].num_springs(), 0);
  const Observations target = test::OwnMotion(scene, kFrames);
  const SelectedModel one = Select(scene, target);
  EXPECT_FALSE(Row(one, "nR").was_fitted);
  EXPECT_THAT(Row(one, "nR").reason, HasSubstr("one group"));
  EXPECT_EQ(one.selection.chosen, "nL");
  std::iota(scene.objects[0].spring_group.begin(), scene.objects[0].spring_group.end(),
            0);
  const SelectedModel each = Select(scene, target);
  EXPECT_EQ(each.selection.chosen, "nR");
  EXPECT_FALSE(Row(each, "nL").was_fitted);
}

// The mass is estimated as the scene says, in every candidate.
TEST(ModelSelectionTest, TheMassStaysAsTheSceneHasIt) {
  Scene scene = Truth('R', 5);
  ApplySettings("GL", &scene);
  EXPECT_EQ(ApplyAutoSettings("auto", &scene), std::vector<int>{0});
  EXPECT_EQ(SettingsString(scene), "GG");
  const double mass = ParameterLayout(scene).Extract(scene)[0];
  scene.objects[0].mass.setConstant(mass);
  const SelectedModel model = Select(scene, test::OwnMotion(scene, kFrames));
  EXPECT_EQ(model.selection.chosen, "GR");
  EXPECT_NEAR(model.summary.parameters[0], mass, 1e-6 * mass);  // drag fixes the scale
}

TEST(ModelSelectionTest, ARicherModelThatFailsIsARowThatSaysWhy) {
  const Scene truth = Truth('R', 5);
  EstimatorOptions options;
  options.init = InitMethod::kUniform;
  options.uniform_value = 20.0;
  options.max_iterations = 1;
  const SelectedModel model = Select(truth, test::OwnMotion(truth, kFrames), options);
  EXPECT_THAT(Row(model, "nR").reason, HasSubstr("the fit stopped early"));
  EXPECT_EQ(Row(model, "nR").termination, Termination::kMaxIterations);
  EXPECT_EQ(model.summary.termination, Termination::kMaxIterations);
}

TEST(ModelSelectionTest, WhereNotEvenTheFirstCanBeFittedItEndsAsEstimateDoes) {
  Scene scene = Truth('R', 5);
  const Observations target = test::OwnMotion(scene, kFrames);
  scene.integration_method = IntegrationMethod::kSymplecticEuler;
  EstimatorOptions options;
  options.init = InitMethod::kUniform;
  options.uniform_value = 1e7;
  options.max_checked_parameters = 0;
  const SelectedModel model = Select(scene, target, options);
  EXPECT_EQ(model.summary.termination, Termination::kStartFailed);
  EXPECT_EQ(model.selection.candidates.size(), 1u);
  EXPECT_EQ(model.selection.chosen, "nG");
}

TEST(ModelSelectionTest, StopsWhenToldAndSaysWhatTheResultIsOf) {
  const Scene truth = Truth('L');
  EstimatorOptions options;
  bool stop = false;
  options.interrupted = [&] { return stop; };
  std::vector<ModelFit> fits;
  ModelSelectionOptions selection;
  selection.objects = {0};
  selection.started = [&](const ModelFit& fit) {
    fits.push_back(fit);
    stop = fit.settings == "nR";
  };
  const SelectedModel model =
      SelectModel(truth, test::OwnMotion(truth, kFrames), options, selection);
  EXPECT_EQ(fits.size(), 2u);
  EXPECT_EQ(fits[1].num_parameters, 3);
  EXPECT_EQ(fits[1].num_frames, 20);
  EXPECT_EQ(model.summary.termination, Termination::kInterrupted);
  EXPECT_EQ(model.selection.chosen, "nG");
  EXPECT_EQ(model.summary.num_frames, 20);
  EXPECT_TRUE(std::isfinite(model.summary.final_rms));
  EXPECT_TRUE(test::HasNote(model.summary, "first 20 frames"));
  EXPECT_THAT(Row(model, "nL").reason, HasSubstr("interrupted"));
}

// The time is for all fits together; the last is left some of it.
TEST(ModelSelectionTest, ProgressRunsInTheTimeOfTheWhole) {
  const Scene truth = Truth('R', 5);
  EstimatorOptions options;
  double last = 0.0;
  bool runs_backwards = false;
  options.progress = [&](const IterationReport& report) {
    runs_backwards |= report.seconds < last;
    last = report.seconds;
  };
  const SelectedModel model = Select(truth, test::OwnMotion(truth, kFrames), options);
  EXPECT_FALSE(runs_backwards);
  EXPECT_GE(model.summary.wall_time_s, last);
}

// Samples between frames are held out by their times.
TEST(ModelSelectionTest, MarkersBetweenFramesAreHeldOutToo) {
  const Scene truth = Truth('R', 5);
  const Trajectory motion =
      Simulator(truth, test::OnlyEstimatedObjects()).Simulate(kFrames);
  Observations target;
  for (const int vertex : {3, 7, 11, 16}) {
    Marker marker;
    marker.vertices = {vertex};
    marker.weights = {1.0};
    target.markers.push_back(marker);
    for (double time = 0.7; time < kFrames - 1; time += 1.3) {
      MarkerSample sample;
      sample.marker = static_cast<int>(target.markers.size()) - 1;
      sample.time = time;
      sample.position = MarkerPosition(motion, marker, time, kFrames);
      target.samples.push_back(sample);
    }
  }
  const SelectedModel model = Select(truth, target);
  EXPECT_EQ(model.selection.chosen, "nR");

  // What was seen of the fitted frames does not enter a forecast.
  StopControl stop(1e9, nullptr);
  const auto forecast = [&] {
    Forecaster forecaster((EstimatorOptions()));
    forecaster.Add(truth, target, 20, kFrames);
    return forecaster.Run({truth}, 1, &stop);
  };
  EXPECT_LT(forecast().rms, 1e-12);
  for (MarkerSample& sample : target.samples) {
    if (sample.time < 19.0) sample.position.setConstant(1.0);
  }
  EXPECT_LT(forecast().rms, 1e-12);
  EXPECT_LT(forecast().residuals.front().norm(), 1e-12);
  EXPECT_GT(forecast().rms_of_all_frames, 1.0);
}

// Two captures of one cloth, of different lengths and starts: what the one does not
// show the other does.
TEST(ModelSelectionTest, SeveralCapturesChooseTogether) {
  for (const char mode : {'G', 'R', 'L'}) {
    const Scene truth = Truth(mode, 5);
    Scene thrown = truth;
    thrown.objects[0].velocities.setConstant(0.5);
    for (int v = 0; v < truth.objects[0].num_vertices(); ++v) {
      if (truth.objects[0].is_fixed[v]) {
        thrown.objects[0].velocities.segment<3>(3 * v).setZero();
      }
    }
    ModelSelectionOptions selection;
    selection.objects = {0};
    const SelectedModel model =
        SelectModel({{test::WithEstimatesOverwritten(truth, 3.0),
                      test::OwnMotion(truth, kFrames), "a"},
                     {test::WithEstimatesOverwritten(thrown, 3.0),
                      test::OwnMotion(thrown, 18), "b"}},
                    EstimatorOptions(), selection);
    EXPECT_EQ(model.selection.chosen, std::string("n") + mode);
    ASSERT_EQ(model.summary.captures.size(), 2u);
    EXPECT_EQ(model.summary.captures[1].num_frames, 18);
    EXPECT_LT(model.summary.final_rms, 1e-9);
  }
}

TEST(ModelSelectionTest, BadInputSaysWhatIsAccepted) {
  const Scene scene = Truth('G', 5);
  const Observations target = test::OwnMotion(scene, kFrames);
  const auto error = [&](const Observations& seen, const EstimatorOptions& options) {
    try {
      Select(scene, seen, options);
    } catch (const SceneError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EstimatorOptions options;
  options.num_frames = 5;
  EXPECT_THAT(error(target, options), AllOf(HasSubstr("5 frames"), HasSubstr("6 or")));
  options = EstimatorOptions();
  options.checkpoint_path = "checkpoint.json";
  EXPECT_THAT(error(target, options), HasSubstr("settings that were chosen"));
  Observations gap = target;
  gap.positions[0].rightCols(10).setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_THAT(error(gap, EstimatorOptions()), HasSubstr("frames 20 to 29"));
}

TEST(ModelSelectionTest, AutoSettings) {
  Scene scene = Truth('G', 4);
  scene.objects.push_back(scene.objects[0]);
  ApplySettings("nn,Ln", &scene);
  Scene copy = scene;
  EXPECT_EQ(ApplyAutoSettings("auto", &copy), std::vector<int>{1});
  EXPECT_EQ(SettingsString(copy), "nn,LG");
  ApplySettings("nn,nn", &copy);
  EXPECT_EQ(ApplyAutoSettings("auto", &copy), (std::vector<int>{0, 1}));
  copy = scene;
  EXPECT_EQ(ApplyAutoSettings("nR,auto", &copy), std::vector<int>{1});
  EXPECT_EQ(SettingsString(copy), "nR,LG");
  EXPECT_TRUE(ApplyAutoSettings("nR", &copy).empty());
  EXPECT_EQ(SettingsString(copy), "nR");
  for (const char* wrong :
       {"autos", "nauto", "auto,autoo", "auto,auto,auto", "auto,"}) {
    EXPECT_THROW(ApplyAutoSettings(wrong, &copy), SceneError) << wrong;
  }
}

// The figures of docs/estimation.md.
TEST(ModelSelectionLongTest, ManyNoises) {
  constexpr int kSeeds = 20;
  for (const char mode : {'G', 'R'}) {
    const Scene truth = Truth(mode, 12);
    std::map<std::string, int> chosen;
    for (int seed = 1; seed <= kSeeds; ++seed) {
      ++chosen[Select(truth, Capture(truth, 100, 30, seed)).selection.chosen];
    }
    for (const auto& [settings, count] : chosen) {
      std::printf("truth n%c: %s chosen %d times of %d\n", mode, settings.c_str(),
                  count, kSeeds);
    }
    EXPECT_GE(chosen[std::string("n") + mode], kSeeds - 2);
  }
}

}  // namespace
}  // namespace dpe
