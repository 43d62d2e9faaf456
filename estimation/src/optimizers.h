// The two ways down: Levenberg-Marquardt and L-BFGS, both by Ceres.
#ifndef DPE_ESTIMATION_OPTIMIZERS_H_
#define DPE_ESTIMATION_OPTIMIZERS_H_

#include <string>

#include "dpe/estimation/estimator.h"
#include "dpe/estimation/trajectory_problem.h"
#include "fit_problem.h"
#include "stop_control.h"

namespace dpe {

struct OptimizerContext {
  FitProblem* fit = nullptr;
  const EstimatorOptions* options = nullptr;
  StopControl* stop = nullptr;
  int num_iterations = 0;   // done so far, over all calls
  int first_iteration = 0;  // from which the default limit of iterations counts

  TrajectoryProblem* problem() const { return fit->problem(); }

  // Reports one iteration to options->progress, if set.
  void Report(IterationReport report) const;
};

struct OptimizerResult {
  Termination termination = Termination::kNumericalFailure;
  std::string message;
};

// Both start at problem()->coordinates() and leave the best point there; the start must
// have been evaluated successfully.
OptimizerResult MinimizeByLevenbergMarquardt(OptimizerContext* context);
OptimizerResult MinimizeByLbfgs(OptimizerContext* context);

}  // namespace dpe

#endif  // DPE_ESTIMATION_OPTIMIZERS_H_
