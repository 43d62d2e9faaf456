// Growing the horizon: fits to the first few frames, then to more and more of them,
// each started from the one before.
//
// A motion depends on its parameters the more strongly the longer it lasts, so that the
// cost over many frames has many local minima, and over few frames one wide basin. What
// the first frames determine is close enough to the answer for a few more. (With
// L-BFGS, which stops far from the answer of each horizon, that is not so.)
//
// What they do not determine a fit to them may change by any factor to follow their
// noise. So each horizon starts from what is better over its own frames: what the one
// before ended with, or what it had started with.
#ifndef DPE_ESTIMATION_HORIZON_H_
#define DPE_ESTIMATION_HORIZON_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "dpe/estimation/checkpoint.h"
#include "dpe/estimation/estimator.h"
#include "fit_setup.h"
#include "optimizers.h"

namespace dpe {

struct GrownHorizon {
  bool ok = false;      // false: not even the first frames could be fitted
  std::string message;  // why not
  std::vector<std::string> notes;
  Eigen::VectorXd coordinates;  // the last horizon's end
  Eigen::VectorXd before;       // and its start: either may be better over all frames
  int num_rollouts = 0;
  int num_derivative_passes = 0;
};

// Fits horizons shorter than all observed frames.
//
// @param captures over all their frames; one that is shorter than a horizon is in it
//                 whole
// @param start    coordinates to start from; need only be simulated for a few frames
// @param context  of the fit: options, stop and iterations are used, and horizons
//                 receives what was fitted
// @param resumed  if not null, where to continue: in which horizon, from which point
GrownHorizon GrowHorizon(const std::vector<FitCapture>& captures,
                         const Eigen::VectorXd& start, OptimizerContext* context,
                         const Checkpoint* resumed = nullptr);

}  // namespace dpe

#endif  // DPE_ESTIMATION_HORIZON_H_
