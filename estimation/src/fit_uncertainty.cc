#include "fit_uncertainty.h"

#include <string>
#include <vector>

#include "fit_problem.h"
#include "prior_rows.h"
#include "residual_correlation.h"
#include "tall_qr.h"

namespace dpe {
namespace {

// Up to so many parameters it takes no time worth mentioning.
constexpr int kFewParameters = 100;

Uncertainty NotComputed(const std::string& why) {
  Uncertainty uncertainty;
  uncertainty.message = why;
  return uncertainty;
}

// R of J = Q R, in chunks of rows.
Eigen::MatrixXd Triangle(const RowMajorMatrix& jacobian, int num_threads) {
  const std::vector<int> chunk_rows = ChunkRows(static_cast<int>(jacobian.rows()));
  Eigen::MatrixXd r;
  TallQr(
      chunk_rows, static_cast<int>(jacobian.cols()), num_threads,
      [&](int chunk, Eigen::Ref<Eigen::MatrixXd> rows) {
        rows = jacobian.middleRows(chunk * kRowsPerChunk, chunk_rows[chunk]);
        return true;
      },
      &r);
  return r;
}

}  // namespace

bool WantsUncertainty(const EstimatorOptions& options, int num_parameters,
                      bool noise_is_known) {
  if (options.uncertainty != UncertaintyMode::kAuto) {
    return options.uncertainty == UncertaintyMode::kOn;
  }
  return noise_is_known || num_parameters <= kFewParameters;
}

Uncertainty UncertaintyOfFit(const std::vector<FitCapture>& captures,
                             bool noise_is_known, const EstimatorOptions& options,
                             TrajectoryEvaluator* evaluator) {
  const double bytes = JacobianBytes(*evaluator);
  if (bytes > options.max_lm_jacobian_bytes) {
    return NotComputed("its Jacobian would take " + std::to_string(bytes / 1e6) +
                       " MB, above the limit of " +
                       std::to_string(options.max_lm_jacobian_bytes / 1e6) + " MB");
  }
  if (!evaluator->Evaluate(evaluator->best_coordinates()) ||
      !evaluator->EvaluateJacobian()) {
    return NotComputed(evaluator->message());
  }
  ResidualCorrelation correlation;
  for (int c = 0; c < static_cast<int>(captures.size()); ++c) {
    CorrelateResiduals(evaluator->trajectory(c), captures[c].observations,
                       captures[c].num_frames, &correlation);
  }
  UncertaintyInput input;
  input.residual_correlation = correlation.rho();
  input.num_residual_pairs = correlation.num_pairs;
  input.scene = &captures[0].blank;
  input.layout = &evaluator->layout();
  input.coordinates = evaluator->best_coordinates();
  input.data_triangle = evaluator->num_segments() == 1
                            ? Triangle(evaluator->jacobian(), options.num_threads)
                            : Triangle(evaluator->DenseJacobian(), options.num_threads);
  input.residual_sum_of_squares = 2.0 * evaluator->data_cost();
  input.num_residuals = evaluator->num_residuals();
  input.noise_is_known = noise_is_known;
  if (!evaluator->prior_rows().empty()) {
    input.prior_rows =
        evaluator->prior_rows().Triangle(input.coordinates, options.num_threads);
  }
  UncertaintyOptions uncertainty_options;
  uncertainty_options.num_threads = options.num_threads;
  return ComputeUncertainty(input, uncertainty_options);
}

}  // namespace dpe
