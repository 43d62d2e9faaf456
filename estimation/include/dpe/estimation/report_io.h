// The machine-readable report of an estimation.
#ifndef DPE_ESTIMATION_REPORT_IO_H_
#define DPE_ESTIMATION_REPORT_IO_H_

#include <string>
#include <vector>

#include "dpe/estimation/estimation_job.h"
#include "dpe/estimation/export.h"

namespace dpe {

// The report as JSON text; what is unknown or not a finite number is null.
//
// scene, settings, target, quality (null: not asked for), integrator and
// steps_per_frame (of the first scene), frames, solver, solver_reason, jacobian, init,
// success, termination, message, notes [], iterations, evaluations,
// jacobian_evaluations, wall_time_s, initial_cost and final_cost (m^2),
// initial_rms_position_error_m, rms_position_error_m, validation {frames,
// rms_position_error_m, note}, parameter_deviation_percent, noise_sigma_m, seed, and
// parameters [{object, capture, kind, mode, unit, values, true_values, elements,
// inactive}]: `elements` names the element of each value in mode L, `inactive` the
// elements without influence on the motion. `capture` (1, 2, ...) is whose alone the
// parameters are, null for those of all.
//
// captures [{scene, target, frames, rms_position_error_m, sigma_m, growth (of its
// sensitivity), validation}]: what is of one capture. With several, scene, target and
// sigma_m of the report itself are null, frames are those of the longest, and errors
// and validation are over all.
//
// @param job          what was asked for
// @param input        what was read
// @param summary      what RunEstimation returned
// @param validations  what Validate returned
// @param selection    null: the settings were given. Otherwise also model_selection
//                     {criterion, frames, fitted_frames, held_out_frames, candidates
//                     [{settings, parameters, termination, iterations, seconds,
//                     fit_rms_m, held_out_rms_m, compared_with, weight,
//                     weight_deviation, kept, reason}], chosen, reason}, see
//                     ModelCandidate
DPE_ESTIMATION_API std::string ReportToJson(const EstimationJob& job,
                                            const EstimationInput& input,
                                            const EstimatorSummary& summary,
                                            const std::vector<Validation>& validations,
                                            const ModelSelection* selection = nullptr);

}  // namespace dpe

#endif  // DPE_ESTIMATION_REPORT_IO_H_
