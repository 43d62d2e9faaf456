// What the examples share: solving, and comparing the answer with the truth.
#ifndef DPE_ESTIMATION_EXAMPLES_EXAMPLE_SUPPORT_H_
#define DPE_ESTIMATION_EXAMPLES_EXAMPLE_SUPPORT_H_

#include <Eigen/Core>

#include "dpe/engine/parameters.h"
#include "dpe/engine/trajectory.h"
#include "dpe/estimation/trajectory_cost.h"
#include "dpe/estimation/trajectory_problem.h"

namespace dpe::examples {

// Checks the derivative of a cost and prints what the check says.
bool CheckAndPrint(const TrajectoryCost& cost, const Trajectory& trajectory);

// Minimises from problem->coordinates() by Levenberg-Marquardt and prints how it went.
// @return the parameters found, SI units, layout order
Eigen::VectorXd Minimize(TrajectoryProblem* problem);

// Prints truth, start and result of every parameter.
// @return true if every parameter was recovered to the relative `tolerance`
bool PrintComparison(const ParameterLayout& layout, const Eigen::VectorXd& truth,
                     const Eigen::VectorXd& start, const Eigen::VectorXd& found,
                     double tolerance);

}  // namespace dpe::examples

#endif  // DPE_ESTIMATION_EXAMPLES_EXAMPLE_SUPPORT_H_
