// The profile of the cost: how low it can be with one parameter held at each of many
// values and the others fitted,
//
//   c_i(t) = min { cost(q) : q_i = t }.
//
// Where one value stands for many that differ, valleys of the cost are long, curved and
// shallow and have several minima along them, which trial values of one parameter with
// the others held do not meet. The profile is followed from a minimum outwards:
// with residuals r(q) and their Jacobian J = [J_i J_o] (column i, the others),
//
//   along the valley   dq_o/dq_i = -(J_o^T J_o)^-1 J_o^T J_i,
//   back to its floor  dq_o      = -(J_o^T J_o)^-1 J_o^T r     (Gauss-Newton),
//
// so that a point costs two or three rollouts with their Jacobians.
#ifndef DPE_ESTIMATION_PROFILE_SCAN_H_
#define DPE_ESTIMATION_PROFILE_SCAN_H_

#include <Eigen/Core>
#include <vector>

#include "dpe/estimation/trajectory_evaluator.h"
#include "stop_control.h"

namespace dpe {

// Follows the profiles of all parameters that are optimised by their logarithm, from
// the evaluator's best point over a decade and a half both ways, or until the cost is
// four times that of the best point (RMS twice): where it rises at once, there is
// nothing to look for and this is cheap.
//
// @return  the minima that the profiles have on the way, the lowest first; without the
//          best point itself
std::vector<Eigen::VectorXd> ProfileMinima(StopControl* stop,
                                           TrajectoryEvaluator* evaluator);

}  // namespace dpe

#endif  // DPE_ESTIMATION_PROFILE_SCAN_H_
