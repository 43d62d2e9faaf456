// Residuals and derivatives as Ceres gets them from a TrajectoryProblem.
#ifndef DPE_TESTS_ESTIMATION_CERES_SUPPORT_H_
#define DPE_TESTS_ESTIMATION_CERES_SUPPORT_H_

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <vector>

#include "dpe/estimation/trajectory_problem.h"

namespace dpe::test {

// Residuals as Ceres gets them from the cost functions.
inline Eigen::VectorXd CeresResiduals(TrajectoryProblem* problem,
                                      const Eigen::VectorXd& q) {
  problem->set_coordinates(q);
  std::vector<double> residuals;
  EXPECT_TRUE(
      problem->least_squares()->Evaluate({}, nullptr, &residuals, nullptr, nullptr));
  return Eigen::Map<Eigen::VectorXd>(residuals.data(), residuals.size());
}

// Ceres's Jacobian of `ceres_problem` (the problem's own or a reduced one), columns in
// layout order.
// The parameter blocks of the problem, or of the reduced one, in the order of the
// coordinates; in the latter some are cut into pieces.
inline std::vector<double*> ParameterBlocksOf(TrajectoryProblem* problem,
                                              const ceres::Problem& ceres_problem) {
  std::vector<double*> blocks;
  for (size_t b = 0; b < problem->layout().blocks().size(); ++b) {
    double* piece = problem->block_coordinates(static_cast<int>(b));
    double* const end = piece + problem->layout().blocks()[b].size;
    for (; piece != end; piece += ceres_problem.ParameterBlockSize(piece)) {
      blocks.push_back(piece);
    }
  }
  return blocks;
}

inline ceres::CRSMatrix CeresJacobian(TrajectoryProblem* problem,
                                      ceres::Problem* ceres_problem,
                                      const Eigen::VectorXd& q) {
  problem->set_coordinates(q);
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = ParameterBlocksOf(problem, *ceres_problem);
  ceres::CRSMatrix jacobian;
  EXPECT_TRUE(ceres_problem->Evaluate(options, nullptr, nullptr, nullptr, &jacobian));
  return jacobian;
}

inline Eigen::MatrixXd Dense(const ceres::CRSMatrix& jacobian) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(jacobian.num_rows, jacobian.num_cols);
  for (int row = 0; row < jacobian.num_rows; ++row) {
    for (int k = jacobian.rows[row]; k < jacobian.rows[row + 1]; ++k) {
      dense(row, jacobian.cols[k]) = jacobian.values[k];
    }
  }
  return dense;
}

// The product of Ceres's Jacobian with a vector.
inline Eigen::VectorXd CeresJacobianTimes(TrajectoryProblem* problem,
                                          const Eigen::VectorXd& q,
                                          const Eigen::VectorXd& direction) {
  return Dense(CeresJacobian(problem, problem->least_squares(), q)) * direction;
}

}  // namespace dpe::test

#endif  // DPE_TESTS_ESTIMATION_CERES_SUPPORT_H_
