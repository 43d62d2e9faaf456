// One value for all elements of a cloth, before each has its own.
//
// From a start at which all elements are alike, what is wrong most is what they have in
// common: a stiffness that is off by a factor of 1e6 is so in every spring. One unknown
// per object finds that in a few cheap iterations; hundreds of them, which each move
// the motion only a little, have to be damped so much on the way that they do not.
#ifndef DPE_ESTIMATION_COMMON_VALUES_H_
#define DPE_ESTIMATION_COMMON_VALUES_H_

#include <Eigen/Core>
#include <vector>

#include "fit_setup.h"
#include "optimizers.h"

namespace dpe {

// True if there are blocks of one unknown per element, and all elements of each such
// block start alike.
bool StartsWithCommonValues(const TrajectoryEvaluator& evaluator,
                            const Eigen::VectorXd& coordinates);

struct CommonValues {
  bool ok = false;              // false: the start stays as it was
  Eigen::VectorXd coordinates;  // of all elements
  int num_rollouts = 0;
  int num_derivative_passes = 0;
};

// Fits with one value per block in place of one per element; priors are left out. Few
// values are looked for over their whole range.
//
// @param captures  cut to the frames to fit
// @param all       the evaluator of a fit to all elements of these captures
// @param start     its coordinates, see StartsWithCommonValues
// @param context   of the fit: options and stop are used, iterations are counted
CommonValues FitCommonValues(const std::vector<FitCapture>& captures,
                             const TrajectoryEvaluator& all,
                             const Eigen::VectorXd& start, OptimizerContext* context);

}  // namespace dpe

#endif  // DPE_ESTIMATION_COMMON_VALUES_H_
