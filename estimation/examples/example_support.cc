#include "example_support.h"

#include <ceres/ceres.h>

#include <cmath>
#include <cstdio>

#include "dpe/estimation/trajectory_cost_check.h"

namespace dpe::examples {

bool CheckAndPrint(const TrajectoryCost& cost, const Trajectory& trajectory) {
  const TrajectoryCostCheck check = CheckTrajectoryCost(cost, trajectory);
  std::printf("Check of the residual: %s\n", check.message.c_str());
  return check.ok;
}

// [minimize]
Eigen::VectorXd Minimize(TrajectoryProblem* problem) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.min_lm_diagonal = 1e-24;  // residuals per unit of ln p may be small
  options.max_num_consecutive_invalid_steps = 60;
  options.function_tolerance = 1e-14;
  options.gradient_tolerance = 1e-18;
  options.parameter_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, problem->least_squares(), &summary);
  std::printf("%s\n", summary.BriefReport().c_str());
  return problem->evaluator()->map().ToParameters(problem->coordinates());
}
// [minimize]

bool PrintComparison(const ParameterLayout& layout, const Eigen::VectorXd& truth,
                     const Eigen::VectorXd& start, const Eigen::VectorXd& found,
                     double tolerance) {
  std::printf("%-18s %14s %14s %14s %12s\n", "parameter", "true", "start", "found",
              "rel. error");
  bool is_recovered = true;
  for (const ParameterBlock& block : layout.blocks()) {
    for (int i = block.offset; i < block.offset + block.size; ++i) {
      const double error = std::abs(found[i] / truth[i] - 1.0);
      std::printf("%-10s %-7s %14.8g %14.8g %14.8g %12.2e\n",
                  ParameterKindName(block.kind).c_str(),
                  ParameterKindUnit(block.kind).c_str(), truth[i], start[i], found[i],
                  error);
      is_recovered &= error <= tolerance;
    }
  }
  std::printf("%s\n", is_recovered ? "recovered" : "NOT recovered");
  return is_recovered;
}

}  // namespace dpe::examples
