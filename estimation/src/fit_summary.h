// What a summary says of each capture of a fit.
#ifndef DPE_ESTIMATION_FIT_SUMMARY_H_
#define DPE_ESTIMATION_FIT_SUMMARY_H_

#include <vector>

#include "dpe/estimation/estimator.h"
#include "fit_problem.h"
#include "fit_setup.h"
#include "stop_control.h"

namespace dpe {

// The captures' scenes with summary->parameters in them, and how well they fit.
// @param has_result  false: no point could be simulated
void SummariseCaptures(const std::vector<CaptureView>& captures, bool has_result,
                       FitProblem* fit, EstimatorSummary* summary);

// The sensitivity of every captured motion; that of the fit is the largest.
void FindSensitivity(const EstimatorOptions& options, StopControl* stop,
                     EstimatorSummary* summary);

}  // namespace dpe

#endif  // DPE_ESTIMATION_FIT_SUMMARY_H_
