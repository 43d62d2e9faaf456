// Experiment 1: what each parameterization reaches, and whether it is the answer.
#ifndef DPE_TOOLS_EXPERIMENTS_FITS_EXPERIMENT1_H_
#define DPE_TOOLS_EXPERIMENTS_FITS_EXPERIMENT1_H_

#include "experiments/experiment.h"

namespace dpe::experiments {

Experiment Experiment1();

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_FITS_EXPERIMENT1_H_
