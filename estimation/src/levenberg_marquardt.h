// What every fit by Levenberg-Marquardt asks of Ceres.
#ifndef DPE_ESTIMATION_LEVENBERG_MARQUARDT_H_
#define DPE_ESTIMATION_LEVENBERG_MARQUARDT_H_

#include <ceres/ceres.h>

namespace dpe {

// The options that do not depend on the problem: dense QR, damping that is relative to
// columns however short, patience with steps that cannot be simulated, silence.
ceres::Solver::Options LevenbergMarquardtOptions();

}  // namespace dpe

#endif  // DPE_ESTIMATION_LEVENBERG_MARQUARDT_H_
