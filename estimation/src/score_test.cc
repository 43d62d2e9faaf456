#include "score_test.h"

#include <cmath>
#include <vector>

#include "fit_problem.h"
#include "fit_setup.h"
#include "tall_qr.h"
#include "uncertainty_algebra.h"

namespace dpe {
namespace {

constexpr double kDeviations = 2.0;

// S and V^T of a Jacobian, by way of its triangular factor.
bool SingularValues(const RowMajorMatrix& jacobian, int num_threads, Eigen::VectorXd* s,
                    Eigen::MatrixXd* vt) {
  const std::vector<int> chunk_rows = ChunkRows(static_cast<int>(jacobian.rows()));
  Eigen::MatrixXd r;
  return TallQr(
             chunk_rows, static_cast<int>(jacobian.cols()), num_threads,
             [&](int chunk, Eigen::Ref<Eigen::MatrixXd> rows) {
               rows = jacobian.middleRows(chunk * kRowsPerChunk, chunk_rows[chunk]);
               return true;
             },
             &r) &&
         Svd(&r, s, vt);
}

ScoreTest Test(const TrajectoryEvaluator& evaluator, int num_threads) {
  ScoreTest test;
  Eigen::VectorXd s;
  Eigen::MatrixXd vt;
  const RowMajorMatrix jacobian = evaluator.DenseJacobian();
  if (!SingularValues(jacobian, num_threads, &s, &vt)) return test;
  const Eigen::VectorXd& r = evaluator.residuals();
  const double m = static_cast<double>(r.size());
  const double noise = std::sqrt(r.squaredNorm() / m);
  const Eigen::VectorXd score = vt * (jacobian.transpose() * r);
  double explained = 0.0;
  for (; test.directions < s.size() && s[test.directions] > noise; ++test.directions) {
    explained += std::pow(score[test.directions] / s[test.directions], 2);
  }
  const double p = test.directions;
  const double rest = r.squaredNorm() - explained;
  if (p < 1.0 || m - p < 2.0 || !(rest > 0.0)) return test;
  test.ok = true;
  test.excess = (explained / (rest / (m - p)) - p) / std::sqrt(2.0 * p * m / (m - p));
  return test;
}

}  // namespace

bool ScoreTest::NothingToGain() const { return ok && excess < kDeviations; }

ScoreTest TestScore(const std::vector<CapturedMotion>& captures,
                    const EstimatorOptions& options, StopControl* stop) {
  std::vector<CaptureView> views;
  std::vector<const Scene*> scenes;
  for (const CapturedMotion& capture : captures) {
    views.push_back({&capture.scene, &capture.observations, capture.name});
    scenes.push_back(&capture.scene);
  }
  EstimatorOptions data_alone = options;
  data_alone.priors.clear();
  data_alone.smoothness.clear();
  FitProblem fit(PrepareCaptures(views, 0), data_alone, stop);
  TrajectoryEvaluator* evaluator = fit.evaluator();
  const Eigen::VectorXd coordinates =
      evaluator->map().ToCoordinates(evaluator->joint_layout().Extract(scenes));
  if (JacobianBytes(*evaluator) > options.max_lm_jacobian_bytes ||
      !evaluator->Evaluate(coordinates) || !evaluator->EvaluateJacobian()) {
    return ScoreTest();
  }
  return Test(*evaluator, options.num_threads);
}

}  // namespace dpe
