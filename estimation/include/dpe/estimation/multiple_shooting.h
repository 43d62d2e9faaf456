// Multiple shooting: a long motion fitted as several short ones that are made to join.
//
// The motion of F frames is cut into windows; window w starts at frame f_w with a state
// s_w = (x, v) of its free vertices that is unknown (the first window's is the
// scene's). With Phi_w(s, p) the state that a rollout comes to at the end of its
// window,
//
//   min over p, s_1, s_2 ...:  sum_w 1/2 |r_w(p, s_w)|^2
//                            + mu^2/2 sum_w |S (Phi_w(s_w, p) - s_{w+1})|^2,
//
// where S leaves positions (m) as they are and multiplies velocities (m/s) by a time
// scale: by the length of a frame unless told otherwise, so that both are the distance
// that the jump shows at the next frame. mu is raised in stages, each of which starts
// where the last one ended, until the largest jump is below a tolerance. Then the
// states say nothing that p does not, and a plain fit of a single rollout removes what
// is left.
//
// Over a short window states depend mildly on the parameters, however wrong these are,
// and observations in the middle of the motion speak where they were made; over the
// whole of it, errors grow from frame to frame, and the cost becomes a landscape of
// many valleys. Growing the horizon from the first frames on gets around these too, and
// for much less work: a window's state is six unknowns per vertex. It needs those
// frames, though: where they were not observed, this way is open. (Bock, Recent
// advances in parameter identification techniques for O.D.E., 1983; Voss, Timmer &
// Kurths, Nonlinear dynamical system identification from uncertain and indirect
// measurements, Int. J. Bifurcation and Chaos 14, 2004. Links as residuals of growing
// weight: a penalty method, Nocedal & Wright, Numerical optimization, section 17.1.)
#ifndef DPE_ESTIMATION_MULTIPLE_SHOOTING_H_
#define DPE_ESTIMATION_MULTIPLE_SHOOTING_H_

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "dpe/engine/scene.h"
#include "dpe/estimation/export.h"
#include "dpe/estimation/observations.h"
#include "dpe/estimation/trajectory_problem.h"

namespace dpe {

struct MultipleShootingOptions {
  // Frame lengths in a window; halved as long as a window cannot be simulated from the
  // start, or ends farther from the next one than the cloth is long.
  int window_frames = 10;
  double time_scale = 0.0;  // s; <= 0: the length of a frame

  // mu of the first stage, per metre if residuals are numbers, and the factor of each
  // further stage.
  double first_weight = 1.0;
  double weight_factor = 10.0;
  int max_stages = 10;
  int max_iterations_per_stage = 30;
  // A stage is done when an iteration lowers its cost by less than this fraction.
  double stage_tolerance = 1e-4;
  // Stop raising mu when no jump is larger, m.
  double continuity_tolerance = 1e-4;

  // Iterations of the final fit of a single rollout; 0: none.
  int max_polish_iterations = 100;
  // A further way to be done: the cost, 1/2 sum of squares.
  double converged_cost = 0.0;

  // Threads, memory and interruption of all rollouts.
  TrajectoryEvaluatorOptions evaluator;

  // Makes the costs of a window, whose scene and observations begin at its own frame 0.
  // Null: MakePositionCosts.
  std::function<TrajectoryCosts(const Scene& window, const Observations& observations,
                                int num_frames)>
      make_costs;

  // If set, called after every iteration with the cost, the length of the step, and
  // whether it was accepted.
  std::function<void(double cost, double step_norm, bool accepted)> progress;

  // If set, called with every problem that is made: to add residuals on its parameters,
  // say a prior on blocks that belong to no segment.
  std::function<void(TrajectoryProblem* problem)> add_residuals;
};

struct MultipleShootingStage {
  double weight = 0.0;  // mu
  int iterations = 0;
  double data_cost = 0.0;     // without the links', at the end
  double largest_jump = 0.0;  // m, at the end
};

struct MultipleShootingSummary {
  bool ok = false;             // a single rollout with `parameters` runs
  bool joined = false;         // the largest jump fell below the tolerance
  std::string message;         // one sentence: how it ended
  Eigen::VectorXd parameters;  // ParameterLayout(scene)'s order, SI units
  int num_windows = 0;
  int window_frames = 0;  // that were used
  std::vector<MultipleShootingStage> stages;
  double joined_cost = 0.0;  // of a single rollout after the last stage
  int polish_iterations = 0;
  double final_cost = 0.0;  // of a single rollout with `parameters`
};

// Estimates what `scene` marks as estimated. States of windows start from the
// observations where a vertex is observed there, else from the rollout of `start`, else
// from the vertex's nearest observation in time.
//
// @param scene         whose marked parameters are estimated
// @param observations  what was seen of it
// @param num_frames    to fit, at least 2
// @param start         parameters, ParameterLayout(scene)'s order, SI units
// @param options       windows, weights, when to stop
// @return              the parameters after the final fit; ok is false if a single
//                      rollout with those of the last stage, then returned, fails
// @throws SceneError if nothing is estimated or observed, or an option makes no sense
DPE_ESTIMATION_API MultipleShootingSummary MultipleShooting(
    const Scene& scene, const Observations& observations, int num_frames,
    const Eigen::VectorXd& start, const MultipleShootingOptions& options = {});

}  // namespace dpe

#endif  // DPE_ESTIMATION_MULTIPLE_SHOOTING_H_
