// The kind of job "floor": the least RMS that one or two values can reach.
//
//   floor = min over p of RMS(x(p), x(the scene's own parameters))
//
// One stiffness for all springs cannot reproduce the motion of a cloth whose springs
// differ; what a fit of it is to be compared with is not 0 but this. It is found by
// rollouts alone: a grid in the logarithms of the values, relative to the mean of what
// the scene says, then golden section (one value) or Nelder-Mead (two) from every one
// of its lowest local minima. Nothing of the estimator is used.
//
// Arguments: preset or scene, grid, settings (of one or two values in all), frames.
// Reports floor_m, value_1 and value_2 (SI units, in the order of the layout),
// evaluations, minima (local ones of the grid).
#ifndef DPE_TOOLS_EXPERIMENTS_FITS_FLOOR_H_
#define DPE_TOOLS_EXPERIMENTS_FITS_FLOOR_H_

#include "experiments/experiment.h"

namespace dpe::experiments {

JobKind FloorKind();

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_FITS_FLOOR_H_
