// The two ways down: Levenberg-Marquardt and L-BFGS, both by Ceres.
#ifndef DPE_ESTIMATION_OPTIMIZERS_H_
#define DPE_ESTIMATION_OPTIMIZERS_H_

#include <functional>
#include <string>

#include "dpe/estimation/estimator.h"
#include "dpe/estimation/trajectory_problem.h"
#include "stop_control.h"

namespace dpe {

struct OptimizerContext {
  TrajectoryProblem* problem = nullptr;
  const EstimatorOptions* options = nullptr;
  StopControl* stop = nullptr;
  double converged_cost = 0.0;  // stop as converged at or below this cost
  std::function<double(double)> rms_of_cost;
  int num_iterations = 0;  // done so far, over all calls

  // Reports one iteration to options->progress, if set.
  void Report(IterationReport report) const;
};

struct OptimizerResult {
  Termination termination = Termination::kNumericalFailure;
  std::string message;
};

// Both start at problem->coordinates() and leave the best point there; the start must
// have been evaluated successfully.
OptimizerResult MinimizeByLevenbergMarquardt(OptimizerContext* context);
OptimizerResult MinimizeByLbfgs(OptimizerContext* context);

}  // namespace dpe

#endif  // DPE_ESTIMATION_OPTIMIZERS_H_
