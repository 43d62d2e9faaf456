// The uncertainty of a fit, from its Jacobian at the best point.
#ifndef DPE_ESTIMATION_FIT_UNCERTAINTY_H_
#define DPE_ESTIMATION_FIT_UNCERTAINTY_H_

#include <vector>

#include "dpe/estimation/estimator.h"
#include "dpe/estimation/trajectory_evaluator.h"
#include "dpe/estimation/uncertainty.h"
#include "fit_setup.h"

namespace dpe {

// Whether options.uncertainty asks for it in a fit of so many parameters.
bool WantsUncertainty(const EstimatorOptions& options, int num_parameters,
                      bool noise_is_known);

// Differentiates at the evaluator's best point, and analyses what comes out. Where the
// Jacobian cannot be computed, or would be larger than options.max_lm_jacobian_bytes,
// the result is not ok and says why.
//
// @param captures  of the fit; the first has the names
Uncertainty UncertaintyOfFit(const std::vector<FitCapture>& captures,
                             bool noise_is_known, const EstimatorOptions& options,
                             TrajectoryEvaluator* evaluator);

}  // namespace dpe

#endif  // DPE_ESTIMATION_FIT_UNCERTAINTY_H_
