// Error bars of a fit to two captures of one cloth, side and corners, with markers on
// some of it: smaller than those of each alone, and true.
//
// Over N fits to the same motions with new noise, e the error of the logarithms and C
// the covariance that a fit reports,
//
//   bias / std      mean of e_j / std_j                 0 +- 1 / sqrt(N)
//   spread          root mean square of (e_j - mean) / std_j     1 +- 1 / sqrt(2 N)
//   NEES            mean of e^T C^-1 e                  n +- sqrt(2 n / N)
//
// see uncertainty_honesty_test.cc.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "dpe/estimation/estimator.h"
#include "estimation/fit_support.h"
#include "support/test_scenes.h"

namespace dpe {
namespace {

constexpr double kSigma = 0.005;  // m
constexpr int kNumParameters = 4;

struct Experiment {
  int resolution = 12;  // vertices per side
  int num_frames = 60;
  int num_markers = 30;
  int num_fits = 200;
};

// One cloth of three stiffnesses and damping, which the model can express exactly,
// lying: held at a side and at its corners.
std::vector<CapturedMotion> CleanCaptures(const Experiment& experiment) {
  std::vector<CapturedMotion> captures;
  for (const char* preset : {"side", "corners"}) {
    Scene scene = test::MakeDerivativeScene(preset, experiment.resolution);
    ApplySettings("nR", &scene);
    scene.objects[0].estimate_damping = true;
    Eigen::VectorXd truth(kNumParameters);
    truth << 45.0, 25.0, 6.0, 0.1;
    ParameterLayout(scene).Insert(truth, &scene);
    Observations motion = test::OwnMotion(scene, experiment.num_frames);
    captures.push_back({std::move(scene), std::move(motion), preset});
  }
  return captures;
}

// The same vertices in all captures and all fits.
std::vector<char> DrawMarkers(int num_vertices, int count) {
  std::vector<int> order(num_vertices);
  for (int v = 0; v < num_vertices; ++v) order[v] = v;
  std::shuffle(order.begin(), order.end(), std::mt19937(11));
  std::vector<char> is_marker(num_vertices, 0);
  for (int k = 0; k < count; ++k) is_marker[order[k]] = 1;
  return is_marker;
}

std::vector<CapturedMotion> Observe(const std::vector<CapturedMotion>& clean,
                                    int num_markers, unsigned seed) {
  std::vector<CapturedMotion> captures = clean;
  for (size_t c = 0; c < captures.size(); ++c) {
    Observations& seen = captures[c].observations;
    AddNoise(captures[c].scene, kSigma, seed + 100000 * c, &seen);
    seen.sigma = kSigma;
    const int num_vertices = captures[c].scene.objects[0].num_vertices();
    const std::vector<char> is_marker = DrawMarkers(num_vertices, num_markers);
    for (int v = 0; v < num_vertices; ++v) {
      if (is_marker[v]) continue;
      seen.positions[0].middleRows(3 * v, 3).setConstant(std::nan(""));
    }
  }
  return captures;
}

struct Fit {
  Eigen::VectorXd error, deviation;  // of the logarithms
  double nees = 0.0;
};

Fit FitTo(const std::vector<CapturedMotion>& captures, const Eigen::VectorXd& truth,
          InitMethod init = InitMethod::kUniform) {
  EstimatorOptions options;
  options.init = init;
  options.uniform_value = 10.0;
  const EstimatorSummary summary = Estimate(captures, options);
  EXPECT_TRUE(summary.usable()) << summary.message;
  EXPECT_TRUE(summary.uncertainty.ok) << summary.uncertainty.message;
  EXPECT_EQ(summary.uncertainty.rank, kNumParameters);
  Fit fit;
  fit.error = (summary.parameters.array() / truth.array()).log();
  fit.deviation = summary.uncertainty.covariance.diagonal().cwiseSqrt();
  fit.nees = fit.error.dot(summary.uncertainty.covariance.ldlt().solve(fit.error));
  return fit;
}

struct Honesty {
  Eigen::VectorXd bias, spread;  // over the reported deviation
  double mean_nees = 0.0;
};

Honesty Measure(const Experiment& experiment) {
  const std::vector<CapturedMotion> clean = CleanCaptures(experiment);
  const Scene& scene = clean[0].scene;
  const Eigen::VectorXd truth = ParameterLayout(scene).Extract(scene);
  Eigen::MatrixXd relative(kNumParameters, experiment.num_fits);
  Honesty honesty;
  for (int k = 0; k < experiment.num_fits; ++k) {
    const Fit fit = FitTo(Observe(clean, experiment.num_markers, 1000 + k), truth);
    relative.col(k) = fit.error.cwiseQuotient(fit.deviation);
    honesty.mean_nees += fit.nees / experiment.num_fits;
  }
  honesty.bias = relative.rowwise().mean();
  honesty.spread = ((relative.colwise() - honesty.bias).rowwise().squaredNorm() /
                    (experiment.num_fits - 1))
                       .cwiseSqrt();
  return honesty;
}

std::string Describe(const Honesty& honesty) {
  std::ostringstream text;
  text << "mean NEES " << honesty.mean_nees << "; bias / std "
       << honesty.bias.transpose() << "; spread / std " << honesty.spread.transpose();
  return text.str();
}

// The error bars of every parameter, together over the smaller one of each alone.
Eigen::VectorXd Gain(const Experiment& experiment) {
  const std::vector<CapturedMotion> clean = CleanCaptures(experiment);
  const Scene& scene = clean[0].scene;
  const Eigen::VectorXd truth = ParameterLayout(scene).Extract(scene);
  const std::vector<CapturedMotion> noisy =
      Observe(clean, experiment.num_markers, 1000);
  // From the truth: a capture alone may have other minima.
  const auto deviation = [&](const std::vector<CapturedMotion>& captures) {
    return FitTo(captures, truth, InitMethod::kScene).deviation;
  };
  const Eigen::VectorXd of_best = deviation({noisy[0]}).cwiseMin(deviation({noisy[1]}));
  return deviation(noisy).cwiseQuotient(of_best);
}

Experiment Small() {
  Experiment experiment;
  experiment.resolution = 6;
  experiment.num_frames = 40;
  experiment.num_markers = 12;
  experiment.num_fits = 40;
  return experiment;
}

TEST(CapturesHonestyTest, TogetherErrorBarsAreSmallerThanOfEachAlone) {
  const Eigen::VectorXd gain = Gain(Small());
  for (int j = 0; j < kNumParameters; ++j) EXPECT_LT(gain[j], 0.99) << j;
}

// Three standard deviations of each figure, of some twelve.
TEST(CapturesHonestyTest, SmallClothOverFewFrames) {
  const Experiment experiment = Small();
  const Honesty honesty = Measure(experiment);
  SCOPED_TRACE(Describe(honesty));
  const double num_fits = experiment.num_fits;
  EXPECT_LT(honesty.bias.lpNorm<Eigen::Infinity>(), 3.0 / std::sqrt(num_fits));
  EXPECT_LT((honesty.spread.array() - 1.0).matrix().lpNorm<Eigen::Infinity>(),
            3.0 / std::sqrt(2.0 * num_fits));
  EXPECT_NEAR(honesty.mean_nees, kNumParameters,
              3.0 * std::sqrt(2.0 * kNumParameters / num_fits));
}

TEST(CapturesHonestyLongTest, SideAndCornersWithThirtyMarkers) {
  const Experiment experiment;
  const Eigen::VectorXd gain = Gain(experiment);
  EXPECT_LT(gain.maxCoeff(), 0.99) << gain.transpose();
  const Honesty honesty = Measure(experiment);
  std::ostringstream figures;
  figures << Describe(honesty) << "; deviations together over the better alone "
          << gain.transpose();
  SCOPED_TRACE(figures.str());
  RecordProperty("figures", figures.str());
  EXPECT_LT(honesty.bias.lpNorm<Eigen::Infinity>(), 0.2);
  EXPECT_LT((honesty.spread.array() - 1.0).matrix().lpNorm<Eigen::Infinity>(), 0.15);
  EXPECT_NEAR(honesty.mean_nees, kNumParameters,
              3.0 * std::sqrt(2.0 * kNumParameters / experiment.num_fits));
}

}  // namespace
}  // namespace dpe
