// What a fit reports.
#ifndef DPE_TOOLS_EXPERIMENTS_FITS_FIT_ROW_H_
#define DPE_TOOLS_EXPERIMENTS_FITS_FIT_ROW_H_

#include <vector>

#include "dpe/estimation/estimation_job.h"
#include "experiments/record.h"

namespace dpe::experiments {

// parameters            how many were estimated
// rms_m                 of the fitted frames
// validation_rms_m      over validate_frames; absent without
// held_out_rms_m        of those of them that were not fitted
// deviation_percent     mean, from the values that made the target; absent where there
//                       is none
// value_...             of blocks of one value, SI units: value_0_mass
// chosen_settings       where settings were to be chosen
// termination, start, solver_used, jacobian_used, iterations, evaluations (rollouts),
// derivative_passes, horizons (how many)
// determined, weak_directions, noise_std   of the error bars, where there are any
// fit_s                 of the fit alone, without making the target and validation
Record FitRow(const EstimatorSummary& summary, const EstimationInput& input,
              const std::vector<Validation>& validations,
              const ModelSelection* selection);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_FITS_FIT_ROW_H_
