// The fits to captures of the size that people have, each with the figures it has to
// reach: minutes of work, so they run with the long tests.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <string>

#include "dpe/engine/scene_io.h"
#include "dpe/estimation/estimator.h"
#include "dpe/estimation/load_target.h"
#include "estimation/fit_support.h"
#include "support/temp_dir.h"

namespace dpe {
namespace {

constexpr int kFitted = 200, kAll = 500;
constexpr double kSigma = 0.001;  // m
constexpr int kSeeds = 3;

Scene Preset(const std::string& name, const std::string& settings) {
  Scene scene = LoadScene(std::string(DPE_SOURCE_DIR "/data/") + name + ".txt");
  ApplySettings(settings, &scene);
  return scene;
}

// The preset with one stiffness per kind of spring, which it hardly has itself.
Scene Grouped(Scene scene) {
  const ParameterLayout layout(scene);
  layout.Insert(layout.Extract(scene), &scene);
  return scene;
}

struct Capture {
  double sigma = kSigma;
  double outliers = 0.0, missing = 0.0;  // fractions
  LossType loss = LossType::kNone;
  int every = 2;  // vertex is a marker
  int seed = 1;
};

EstimatorSummary FitCapture(const Scene& scene, const Capture& capture) {
  Observations seen = test::OwnMotion(scene, kFitted);
  if (capture.sigma > 0.0) AddNoise(scene, capture.sigma, capture.seed, &seen);
  seen.sigma = capture.sigma;
  std::mt19937_64 generator(1000 + capture.seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::normal_distribution<double> normal;
  for (int f = 1; f < kFitted; ++f) {
    for (int v = 0; v < scene.objects[0].num_vertices(); ++v) {
      auto position = seen.positions[0].col(f).segment<3>(3 * v);
      const Eigen::Vector3d direction(normal(generator), normal(generator),
                                      normal(generator));
      const double draw = uniform(generator);
      if (v % capture.every != 0 || draw < capture.missing) {
        position.setConstant(std::numeric_limits<double>::quiet_NaN());
      } else if (draw < capture.missing + capture.outliers) {
        position += 0.1 * direction.normalized();
      }
    }
  }
  EstimatorOptions options;
  options.loss = capture.loss;
  const EstimatorSummary summary = Estimate(scene, seen, options);
  EXPECT_TRUE(summary.usable()) << summary.message;
  EXPECT_TRUE(summary.uncertainty.ok) << summary.uncertainty.message;
  return summary;
}

// ln(p / truth) and the same in reported deviations.
Eigen::VectorXd Errors(const EstimatorSummary& summary, const Scene& truth) {
  return (summary.parameters.array() / ParameterLayout(truth).Extract(truth).array())
      .log();
}
double LargestInDeviations(const EstimatorSummary& summary, const Scene& truth) {
  return (Errors(summary, truth).array() /
          summary.uncertainty.covariance.diagonal().array().sqrt())
      .abs()
      .maxCoeff();
}

// Of the fitted scene against the motion without noise.
double RmsOverAll(const EstimatorSummary& summary, const Observations& truth) {
  return RmsPositionError(Simulator(summary.scene).Simulate(kAll), truth, kAll);
}

void Print(const char* what, double value) { std::printf("%s: %.3g\n", what, value); }

// Three stiffnesses of the flag from every second vertex, 1 mm, 200 frames.
TEST(CaptureLongTest, ThreeStiffnessesOfTheFlag) {
  const Scene scene = Grouped(Preset("flag", "nR"));
  const Observations truth = test::OwnMotion(scene, kAll);
  for (Capture capture; capture.seed <= kSeeds; ++capture.seed) {
    const EstimatorSummary fit = FitCapture(scene, capture);
    const double largest = LargestInDeviations(fit, scene);
    const double rms = RmsOverAll(fit, truth);
    Print("largest error, standard deviations", largest);
    Print("RMS over 500 frames, m", rms);
    EXPECT_LT(largest, 3.0);
    EXPECT_LT(rms, 2.0 * kSigma);  // the model without noise leaves none
  }
}

// The preset itself has border springs that differ from the others of their kind: what
// noise adds to the error of a model that is too simple.
TEST(CaptureLongTest, NoiseHardlyAddsToTheErrorOfAModelThatIsTooSimple) {
  const Scene scene = Preset("flag", "nR");
  const Observations truth = test::OwnMotion(scene, kAll);
  Capture capture;
  capture.sigma = 0.0;
  const double noise_free = RmsOverAll(FitCapture(scene, capture), truth);
  capture.sigma = kSigma;
  const double noisy = RmsOverAll(FitCapture(scene, capture), truth);
  Print("RMS over 500 frames without noise, m", noise_free);
  Print("RMS over 500 frames with noise, m", noisy);
  EXPECT_LT(noisy, noise_free + 2.0 * kSigma);
}

TEST(CaptureLongTest, OutliersAndGaps) {
  const Scene scene = Grouped(Preset("flag", "nR"));
  double clean = 0.0, robust = 0.0;
  for (Capture capture; capture.seed <= kSeeds; ++capture.seed) {
    clean += Errors(FitCapture(scene, capture), scene).squaredNorm();
    Capture with_outliers = capture;
    with_outliers.outliers = 0.05;
    with_outliers.loss = LossType::kCauchy;
    robust += Errors(FitCapture(scene, with_outliers), scene).squaredNorm();
    Capture with_gaps = capture;
    with_gaps.missing = 0.3;
    const double largest = LargestInDeviations(FitCapture(scene, with_gaps), scene);
    Print("30 % missing: largest error, standard deviations", largest);
    EXPECT_LT(largest, 3.0);
  }
  Print("error with outliers over error without", std::sqrt(robust / clean));
  EXPECT_LT(std::sqrt(robust / clean), 2.0);
}

// Observed at 60 Hz while steps are at 50 Hz, in mm with z up, against a plain file.
TEST(CaptureLongTest, AnotherRateAndOtherUnitsGiveTheSameParameters) {
  Scene scene = Grouped(Preset("flag", "nR"));
  scene.objects[0].estimate_damping = true;
  const Trajectory motion = Simulator(scene).Simulate(kFitted);
  const test::TempDir folder;
  const std::string plain = folder.File("plain.csv"), other = folder.File("other.csv");
  std::FILE* file = std::fopen(plain.c_str(), "w");
  std::fprintf(file, "frame,vertex,x,y,z\n");
  const int num_vertices = scene.objects[0].num_vertices();
  for (int f = 0; f < kFitted; ++f) {
    for (int v = 0; v < num_vertices; ++v) {
      const Eigen::Vector3d x = motion.positions[0].col(f).segment<3>(3 * v);
      std::fprintf(file, "%d,%d,%.15g,%.15g,%.15g\n", f, v, x.x(), x.y(), x.z());
    }
  }
  std::fclose(file);
  file = std::fopen(other.c_str(), "w");
  std::fprintf(file, "time,vertex,x,y,z\n");
  for (int k = 0; k / 60.0 <= (kFitted - 1) * scene.delta; ++k) {
    for (int v = 0; v < num_vertices; ++v) {
      Marker marker;
      marker.vertices = {v};
      marker.weights = {1.0};
      const Eigen::Vector3d x =
          1000.0 * MarkerPosition(motion, marker, k / 60.0 / scene.delta, kFitted);
      std::fprintf(file, "%.15g,%d,%.15g,%.15g,%.15g\n", k / 60.0, v, x.x(), -x.z(),
                   x.y());
    }
  }
  std::fclose(file);
  TargetOptions options;
  const Observations from_plain = LoadTarget(plain, options, &scene);
  options.capture.scale = 0.001;
  options.capture.up = UpAxis::kZ;
  const Observations from_other = LoadTarget(other, options, &scene);
  const EstimatorSummary a = Estimate(scene, from_plain, {});
  const EstimatorSummary b = Estimate(scene, from_other, {});
  const double difference =
      (a.parameters.array() / b.parameters.array()).log().abs().maxCoeff();
  Print("largest relative difference of the parameters", difference);
  EXPECT_LT(difference, 1e-6);
  EXPECT_LT(Errors(b, scene).cwiseAbs().maxCoeff(), 1e-6);
}

}  // namespace
}  // namespace dpe
