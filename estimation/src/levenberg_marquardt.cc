#include "levenberg_marquardt.h"

namespace dpe {

ceres::Solver::Options LevenbergMarquardtOptions() {
  ceres::Solver::Options options;
  options.minimizer_type = ceres::TRUST_REGION;
  options.trust_region_strategy_type = ceres::LEVENBERG_MARQUARDT;
  // QR does not square the condition number, as normal equations would.
  options.linear_solver_type = ceres::DENSE_QR;
  options.dense_linear_algebra_library_type = ceres::LAPACK;
  // Enough for a trust region to shrink from its default to a useful size while every
  // trial step's rollout fails.
  options.max_num_consecutive_invalid_steps = 60;
  // The damping is relative to the squared column lengths of J. Ceres raises those to
  // 1e-6 before, which would drown columns of short lengths (m per unit of ln p).
  options.min_lm_diagonal = 1e-24;
  // Damping that is the same for all unknowns may have to become very small for the
  // last digits of those that hardly move the motion.
  options.max_trust_region_radius = 1e30;
  options.logging_type = ceres::SILENT;
  return options;
}

}  // namespace dpe
