// The two ways down: Levenberg-Marquardt and L-BFGS, both by Ceres.
#ifndef DPE_ESTIMATION_OPTIMIZERS_H_
#define DPE_ESTIMATION_OPTIMIZERS_H_

#include <functional>
#include <string>
#include <vector>

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
  // With which Levenberg-Marquardt is to start, once; 0: its default. A radius is that
  // of Ceres's trust region divided by its uniform damping (see SetUniformDamping), so
  // that the next solve can go on with the steps of the one before.
  double initial_radius = 0.0;
  double last_radius = 0.0;  // after the last accepted step; 0: the last solve had none
  std::vector<HorizonStage>
      horizons;  // fitted so far, and the one that is being fitted
  // Called after every iteration whose step was accepted, if set.
  // @param context  of the optimiser at work
  // @param radius   of the trust region; 0: there is none
  std::function<void(const OptimizerContext& context, double radius)> accepted;

  TrajectoryProblem* problem() const { return fit->problem(); }

  // True if there is to be no further iteration: the fit was stopped, or the user's
  // limit is reached.
  bool is_over() const {
    return stop->stopped() ||
           (options->max_iterations >= 0 && num_iterations >= options->max_iterations);
  }

  // Reports one iteration to options->progress, if set.
  void Report(IterationReport report) const;
};

struct OptimizerResult {
  Termination termination = Termination::kNumericalFailure;
  std::string message;
};

// Starts at problem()->coordinates(), which must have been evaluated successfully, and
// leaves the best point there.
// @param use_lm  Levenberg-Marquardt, else L-BFGS
OptimizerResult Minimize(bool use_lm, OptimizerContext* context);

}  // namespace dpe

#endif  // DPE_ESTIMATION_OPTIMIZERS_H_
