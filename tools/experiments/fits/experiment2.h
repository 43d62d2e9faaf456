// Experiment 2: how far a fit to few frames foretells the motion.
#ifndef DPE_TOOLS_EXPERIMENTS_FITS_EXPERIMENT2_H_
#define DPE_TOOLS_EXPERIMENTS_FITS_EXPERIMENT2_H_

#include "experiments/experiment.h"

namespace dpe::experiments {

Experiment Experiment2();

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_FITS_EXPERIMENT2_H_
