// The kind of job "estimate": one fit, as estimate_cloth makes it.
//
// Arguments (docs/experiments.md has them with their meaning): what estimate_cloth's
// flags of the same names say, and "preset" and "grid" for a scene that is made. It
// reports what the fit reached, how, and in what time; files it writes none.
#ifndef DPE_TOOLS_EXPERIMENTS_FITS_ESTIMATE_H_
#define DPE_TOOLS_EXPERIMENTS_FITS_ESTIMATE_H_

#include "dpe/estimation/estimation_job.h"
#include "experiments/experiment.h"

namespace dpe::experiments {

JobKind EstimateKind();

// The estimation that a job's arguments describe, all but its scenes.
// @throws SceneError naming an argument that does not exist or has a wrong value
EstimationJob EstimationOf(const Job& job);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_FITS_ESTIMATE_H_
