// What tells one fit from another: everything that its result depends on.
#ifndef DPE_ESTIMATION_FINGERPRINT_H_
#define DPE_ESTIMATION_FINGERPRINT_H_

#include <vector>

#include "dpe/estimation/checkpoint.h"
#include "dpe/estimation/estimator.h"
#include "fit_setup.h"

namespace dpe {

// Scenes, what is estimated, observations, and those options that decide where the
// optimiser goes. Not among them is what changes only when it stops and how fast it
// gets there: limits of iterations and time, tolerances, threads, memory.
Fingerprint FingerprintOf(const std::vector<CaptureView>& captures,
                          const EstimatorOptions& options);

}  // namespace dpe

#endif  // DPE_ESTIMATION_FINGERPRINT_H_
