// The fit to the first frames of what was observed as an optimisation problem, and how
// far it has got.
#ifndef DPE_ESTIMATION_FIT_PROBLEM_H_
#define DPE_ESTIMATION_FIT_PROBLEM_H_

#include <Eigen/Core>
#include <memory>
#include <string>

#include "dpe/engine/scene.h"
#include "dpe/estimation/estimator.h"
#include "dpe/estimation/observations.h"
#include "dpe/estimation/trajectory_problem.h"
#include "stop_control.h"

namespace dpe {

class FitProblem {
 public:
  // @param blank    the scene without its values of what is estimated
  // @param stop     polled within rollouts; must outlive this
  // @throws SceneError if nothing that could be fitted is observed in these frames
  FitProblem(const Scene& blank, const Observations& observations, int num_frames,
             const EstimatorOptions& options, StopControl* stop);
  FitProblem(const FitProblem&) = delete;
  FitProblem& operator=(const FitProblem&) = delete;

  TrajectoryProblem* problem() { return problem_.get(); }
  TrajectoryEvaluator* evaluator() { return problem_->evaluator(); }
  const Observations& observations() const { return observations_; }
  int num_frames() const { return num_frames_; }

  // True if residuals are in standard deviations, false if in m.
  bool noise_is_known() const { return noise_is_known_; }

  // RMS position error at the point of least cost so far, m; NaN before there is one.
  double best_rms() const { return best_rms_; }
  // True if that point's cost is nothing but rounding (options.rms_tolerance).
  bool IsAtRounding() const;

 private:
  const int num_frames_;
  const Observations observations_;  // of these frames
  bool noise_is_known_ = false;
  double best_rms_;
  double converged_cost_ = 0.0;
  std::unique_ptr<TrajectoryProblem> problem_;
};

struct SolverChoice {
  bool is_lm = true;
  std::string reason;
};

// What options.solver means for a problem of this size.
SolverChoice ChooseSolver(const TrajectoryEvaluator& evaluator,
                          const EstimatorOptions& options);

}  // namespace dpe

#endif  // DPE_ESTIMATION_FIT_PROBLEM_H_
