// The kinds of jobs of which the trade-off experiment consists.
#ifndef DPE_TOOLS_EXPERIMENTS_TRADEOFF_JOBS_H_
#define DPE_TOOLS_EXPERIMENTS_TRADEOFF_JOBS_H_

#include "experiments/experiment.h"

namespace dpe::experiments::tradeoff {

// Simulates a scene with a candidate's settings (candidate.h).
//
// @param job  the candidate, and "difference": whether to check the gradient by
//             differences as well
// @return     stopped (text: why the simulation failed, else empty), steps_per_frame,
//             rms_H_m and max_H_m for each horizon H, the work per frame (SetWork),
//             gradient_error, difference_error, frame_s (least processor time per
//             frame, s), kept_mib (what a rollout of kGradientFrames keeps for
//             derivatives)
Record RunSimulationJob(const Job& job);

// Fits stiffnesses to the reference motion with a candidate's settings.
//
// What the fit then has in it that is not the truth is the error of the candidate's
// time stepping: the bias that anyone has who fits to a motion of the real world with
// that time stepping.
//
// @param job  the candidate, and settings (two letters), estimate (as the flag, one
//             quantity), fit_solver (auto, lm, lbfgs), horizon (auto, full, grow,
//             shooting), init (auto, uniform), max_iterations, memory_limit_mib
// @return     stopped (text: why the fit is not usable, else empty), parameters,
//             bias_percent (mean of |p - p_true| / |p_true|), worst_percent,
//             residual_rms_m, iterations, rollouts, passes, total_steps (of all
//             rollouts),
//             fit_s (processor time), solver_used
Record RunFitJob(const Job& job);

}  // namespace dpe::experiments::tradeoff

#endif  // DPE_TOOLS_EXPERIMENTS_TRADEOFF_JOBS_H_
