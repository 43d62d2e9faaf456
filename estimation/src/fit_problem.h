// The fit to the first frames of one or several captures as an optimisation problem,
// and how far it has got. What is shared between captures, and what each has for
// itself, is said in joint_layout.h; a wind that is estimated is each capture's own.
#ifndef DPE_ESTIMATION_FIT_PROBLEM_H_
#define DPE_ESTIMATION_FIT_PROBLEM_H_

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "dpe/estimation/estimator.h"
#include "dpe/estimation/trajectory_problem.h"
#include "fit_setup.h"
#include "stop_control.h"

namespace dpe {

class FitProblem {
 public:
  // @param captures  each its own rollout, over all its frames
  // @param stop      polled within rollouts; must outlive this
  // @throws SceneError if nothing that could be fitted is observed in these frames
  FitProblem(std::vector<FitCapture> captures, const EstimatorOptions& options,
             StopControl* stop);
  FitProblem(const FitProblem&) = delete;
  FitProblem& operator=(const FitProblem&) = delete;

  TrajectoryProblem* problem() { return problem_.get(); }
  TrajectoryEvaluator* evaluator() { return problem_->evaluator(); }
  const std::vector<FitCapture>& captures() const { return captures_; }
  int num_frames() const { return num_frames_; }  // of the longest capture

  // True if residuals are in standard deviations, false if in m.
  bool noise_is_known() const { return noise_is_known_; }

  // RMS position error at the point of least cost so far, m; NaN before there is one.
  double best_rms() const { return best_rms_; }
  // The same of one capture alone.
  double best_rms(int capture) const { return best_rms_of_[capture]; }
  // True if that point's cost is nothing but rounding (options.rms_tolerance).
  bool IsAtRounding() const;

 private:
  void MeasureErrors();

  const std::vector<FitCapture> captures_;
  const int num_frames_;
  bool noise_is_known_ = false;
  double best_rms_;
  std::vector<double> best_rms_of_;
  double converged_cost_ = 0.0;
  std::unique_ptr<TrajectoryProblem> problem_;
};

// What residuals of a fit, and their evaluator, take from its options.
// @param stop  polled within rollouts; must outlive the evaluator
PositionCostOptions CostOptionsOf(const EstimatorOptions& options);
TrajectoryEvaluatorOptions EvaluatorOptionsOf(const EstimatorOptions& options,
                                              StopControl* stop);

// What the Jacobian takes in memory as one dense matrix.
double JacobianBytes(const TrajectoryEvaluator& evaluator);

struct SolverChoice {
  bool is_lm = true;
  std::string reason;
};

// What options.solver means for a problem of this size.
SolverChoice ChooseSolver(const TrajectoryEvaluator& evaluator,
                          const EstimatorOptions& options);

}  // namespace dpe

#endif  // DPE_ESTIMATION_FIT_PROBLEM_H_
