// Are the reported deviations those that estimates really have? The same motion is
// observed over and over with new noise, and the estimates' errors e are compared with
// the covariance C that each fit reports:
//
//   NEES = e^T C^-1 e   has a chi-square distribution with n degrees of freedom if C is
//                       honest; its mean is n, that of N fits n +- sqrt(2 n / N)
//   bias / std          mean of e_j / std_j,                      0 +- 1 / sqrt(N)
//   spread ratio        root mean square of (e_j - mean) / std_j, 1 +- 1 / sqrt(2 N)
//
// (Bar-Shalom, Li & Kirubarajan, Estimation with Applications to Tracking and
// Navigation, 2001, section 5.4.2: normalised estimation error squared.)
#include <ceres/ceres.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <sstream>

#include "dpe/engine/simulator.h"
#include "dpe/estimation/trajectory_problem.h"
#include "fit_support.h"
#include "support/test_scenes.h"
#include "uncertainty_support.h"

namespace dpe {
namespace {

constexpr double kSigma = 0.005;  // m

struct Experiment {
  int resolution = 12;  // vertices per side
  int num_frames = 100;
  int num_markers = 30;
  int num_fits = 200;
};

struct Honesty {
  int num_converged = 0;
  double mean_nees = 0.0;
  Eigen::VectorXd bias, spread;  // over the reported deviation
  double mean_chi_square = 0.0;
};

// Side, three stiffnesses and damping. The preset's springs at the border are softer
// than the others of their kind; here all of a kind are alike, so that the model can be
// right.
Scene MakeScene(int resolution) {
  Scene scene = test::MakeDerivativeScene("side", resolution);
  ApplySettings("nR", &scene);
  scene.objects[0].estimate_damping = true;
  const ParameterLayout layout(scene);
  layout.Insert(layout.Extract(scene), &scene);
  return scene;
}

// `count` free vertices, drawn without replacement.
std::vector<char> DrawMarkers(const ClothObject& object, int count) {
  std::vector<int> candidates;
  for (int v = 0; v < object.num_vertices(); ++v) {
    if (!object.is_fixed[v]) candidates.push_back(v);
  }
  std::mt19937 generator(11);
  std::shuffle(candidates.begin(), candidates.end(), generator);
  std::vector<char> is_marker(object.num_vertices(), 0);
  for (int k = 0; k < count; ++k) is_marker[candidates[k]] = 1;
  return is_marker;
}

Observations Observe(const Scene& scene, const Observations& motion,
                     const std::vector<char>& is_marker, unsigned seed) {
  Observations observations = motion;
  AddNoise(scene, kSigma, seed, &observations);
  observations.sigma = 0.0;  // residuals in metres; the test divides by sigma
  for (size_t v = 0; v < is_marker.size(); ++v) {
    if (is_marker[v]) continue;
    observations.positions[0].middleRows(3 * v, 3).setConstant(std::nan(""));
  }
  return observations;
}

// Minimises from a start that is off by factors of about exp(0.3).
bool Minimise(const Eigen::VectorXd& truth, unsigned seed, TrajectoryProblem* problem) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal(0.0, 0.3);
  Eigen::VectorXd start = truth;
  for (double& value : start) value += normal(generator);
  problem->set_coordinates(start);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.function_tolerance = 1e-14;
  options.parameter_tolerance = 1e-10;
  options.max_num_iterations = 100;
  ceres::Solver::Summary summary;
  ceres::Solve(options, problem->NewReducedLeastSquares().get(), &summary);
  return summary.termination_type == ceres::CONVERGENCE;
}

Uncertainty UncertaintyAt(const Scene& scene, TrajectoryProblem* problem) {
  TrajectoryEvaluator* evaluator = problem->evaluator();
  EXPECT_TRUE(evaluator->Evaluate(problem->coordinates()) &&
              evaluator->EvaluateJacobian());
  UncertaintyInput input;
  input.scene = &scene;
  input.layout = &problem->layout();
  input.coordinates = problem->coordinates();
  input.data_triangle = test::TriangleOf(evaluator->jacobian()) / kSigma;
  input.residual_sum_of_squares =
      evaluator->residuals().squaredNorm() / (kSigma * kSigma);
  input.num_residuals = evaluator->num_residuals();
  input.noise_is_known = true;
  return ComputeUncertainty(input);
}

Honesty Measure(const Experiment& experiment) {
  const Scene scene = MakeScene(experiment.resolution);
  const Observations motion = test::OwnMotion(scene, experiment.num_frames);
  const std::vector<char> is_marker =
      DrawMarkers(scene.objects[0], experiment.num_markers);
  const ParameterLayout layout(scene);
  const Eigen::VectorXd truth =
      ParameterMap(layout).ToCoordinates(layout.Extract(scene));
  Eigen::MatrixXd relative(layout.size(), experiment.num_fits);  // e_j / std_j
  Honesty result;
  for (int k = 0; k < experiment.num_fits; ++k) {
    const Observations observations = Observe(scene, motion, is_marker, 1000 + k);
    TrajectoryProblem problem(
        scene, MakePositionCosts(scene, observations, experiment.num_frames));
    result.num_converged += Minimise(truth, 5000 + k, &problem);
    const Uncertainty uncertainty = UncertaintyAt(scene, &problem);
    EXPECT_TRUE(uncertainty.ok) << uncertainty.message;
    const Eigen::VectorXd error = problem.coordinates() - truth;
    result.mean_nees += error.dot(uncertainty.covariance.ldlt().solve(error));
    result.mean_chi_square += uncertainty.reduced_chi_square;
    relative.col(k) =
        error.cwiseQuotient(uncertainty.covariance.diagonal().cwiseSqrt());
  }
  result.mean_nees /= experiment.num_fits;
  result.mean_chi_square /= experiment.num_fits;
  result.bias = relative.rowwise().mean();
  result.spread = ((relative.colwise() - result.bias).rowwise().squaredNorm() /
                   (experiment.num_fits - 1))
                      .cwiseSqrt();
  return result;
}

std::string Describe(const Honesty& honesty) {
  std::ostringstream text;
  text << honesty.num_converged << " converged; mean NEES " << honesty.mean_nees
       << "; bias / std " << honesty.bias.transpose() << "; spread / std "
       << honesty.spread.transpose() << "; mean reduced chi-square "
       << honesty.mean_chi_square;
  return text.str();
}

TEST(UncertaintyHonestyTest, SmallClothOverFewFrames) {
  Experiment experiment;
  experiment.resolution = 6;
  experiment.num_frames = 40;
  experiment.num_markers = 10;
  experiment.num_fits = 100;
  const Honesty honesty = Measure(experiment);
  SCOPED_TRACE(Describe(honesty));
  const double n = 4.0, num_fits = experiment.num_fits;
  // Three standard deviations of each figure.
  EXPECT_EQ(honesty.num_converged, num_fits);
  EXPECT_NEAR(honesty.mean_nees, n, 3.0 * std::sqrt(2.0 * n / num_fits));
  EXPECT_LT(honesty.bias.lpNorm<Eigen::Infinity>(), 3.0 / std::sqrt(num_fits));
  EXPECT_LT((honesty.spread.array() - 1.0).matrix().lpNorm<Eigen::Infinity>(),
            3.0 / std::sqrt(2.0 * num_fits));
}

// The criteria are those of a user's trust: error squares within 10 per cent, bias
// below a fifth of a deviation, spreads within 15 per cent.
TEST(UncertaintyHonestyLongTest, SideWithThirtyMarkers) {
  const Experiment experiment;
  const Honesty honesty = Measure(experiment);
  const std::string description = Describe(honesty);
  SCOPED_TRACE(description);
  RecordProperty("figures", description);
  EXPECT_EQ(honesty.num_converged, experiment.num_fits);
  EXPECT_NEAR(honesty.mean_nees, 4.0, 0.4);
  EXPECT_LT(honesty.bias.lpNorm<Eigen::Infinity>(), 0.2);
  EXPECT_LT((honesty.spread.array() - 1.0).matrix().lpNorm<Eigen::Infinity>(), 0.15);
  EXPECT_NEAR(honesty.mean_chi_square, 1.0, 0.01);
}

}  // namespace
}  // namespace dpe
