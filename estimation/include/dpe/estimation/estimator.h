// The main job: recover a scene's estimated parameters from observed positions.
#ifndef DPE_ESTIMATION_ESTIMATOR_H_
#define DPE_ESTIMATION_ESTIMATOR_H_

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "dpe/engine/scene.h"
#include "dpe/engine/sensitivity.h"
#include "dpe/engine/trajectory.h"
#include "dpe/estimation/export.h"
#include "dpe/estimation/motion_sensitivity.h"
#include "dpe/estimation/observations.h"
#include "dpe/estimation/priors.h"
#include "dpe/estimation/robust_loss.h"
#include "dpe/estimation/uncertainty.h"

namespace dpe {

enum class SolverType { kAuto, kLevenbergMarquardt, kLbfgs };

// Where the optimiser starts.
enum class InitMethod {
  kAuto,             // inverse dynamics if every free vertex is observed, else screen
                     // for up to `max_screen_parameters` parameters, else the scene
  kInverseDynamics,  // linear least squares on the step equations
  kScene,            // the scene file's own values
  kUniform,          // one value for every estimated parameter
  kScreen,           // log-spaced trial values on a short horizon, the best one
};

// Over which frames the optimiser works its way to all of them.
enum class Horizon {
  kAuto,  // grow with LM, unless inverse dynamics gave the start, else full
  kFull,  // all at once
  // The first few frames, then more and more, each from the one before. Where each
  // element has its own unknown and all start alike, one value for all comes first.
  kGrow,
  // Short windows with unknown states that are made to join (multiple_shooting.h), then
  // all at once; of one capture only. A state is 6 unknowns per vertex and window.
  kShooting,
};

enum class UncertaintyMode {
  kAuto,  // where the noise is known, or there are at most 100 parameters
  kOn,
  kOff,
};

// One horizon that a fit went through on its way.
struct HorizonStage {
  int num_frames = 0;
  int iterations = 0;
  double start_rms = 0.0;  // m, NaN if the start could not be simulated
  double final_rms = 0.0;  // m
};

// What a progress callback is told after every iteration.
struct IterationReport {
  int iteration = 0;
  int num_frames = 0;      // of the horizon that is being fitted
  double cost = 0.0;       // 1/2 sum of squared residuals
  double rms = 0.0;        // m, of the best point so far
  double step_norm = 0.0;  // in the optimiser's (log) coordinates
  double gradient_max_norm = 0.0;
  double seconds = 0.0;  // since the start
  bool step_accepted = true;
};

struct EstimatorOptions {
  SolverType solver = SolverType::kAuto;
  JacobianMethod jacobian = JacobianMethod::kAuto;
  InitMethod init = InitMethod::kAuto;
  double uniform_value = 1.0;      // for kUniform, in each parameter's SI unit
  double init_perturbation = 0.0;  // multiply the start by exp(this * N(0,1)), seeded
  std::uint64_t seed = 0;          // of the perturbation
  int max_screen_parameters = 8;   // for kAuto, see there
  // With at most this many parameters the fit, after it has converged, is checked
  // against log-spaced trial values and against minima along the valley of the cost
  // that it lies in, and repeated from a better one if there is any; a start that
  // cannot be simulated is replaced by the screen's best. Notes say so. 0 turns it off.
  int max_checked_parameters = 3;
  int max_iterations = -1;  // negative: 200 for LM, 5000 for L-BFGS
  double max_seconds = 1e9;
  // If not empty, the parameters (layout order, SI units) to start from as they are,
  // instead of `init`; Horizon::kAuto is then kFull.
  Eigen::VectorXd start;
  int num_threads = 1;
  // What the fit's rollouts may keep beyond their trajectories, see SimulatorOptions.
  std::size_t memory_limit_bytes = SimulatorOptions().memory_limit_bytes;
  int num_frames = 0;  // frames to fit; <= 0: as many as were observed

  // What an observation far from the model counts, and its scale in standard deviations
  // of the noise (m where that is not known); 0: RobustLoss::DefaultScale.
  LossType loss = LossType::kNone;
  double loss_scale = 0.0;

  // What is known beforehand; the noise has to be known, too.
  std::vector<Prior> priors;
  std::vector<SmoothnessPrior> smoothness;

  Horizon horizon = Horizon::kAuto;
  // Error bars cost one Jacobian and its decomposition.
  UncertaintyMode uncertainty = UncertaintyMode::kAuto;

  // SolverType::kAuto takes LM as long as its dense Jacobian (8 bytes x residuals x
  // parameters; beside it LM keeps some twenty matrices of parameters x parameters)
  // is not larger than this, else L-BFGS.
  double max_lm_jacobian_bytes = 1e9;

  // The fit stops as converged when the RMS has fallen below this (m): beneath it there
  // is only rounding error. Relative to the scene's size of a few metres.
  double rms_tolerance = 1e-12;
  // As in ceres::Solver::Options.
  double function_tolerance = 1e-12;
  double gradient_tolerance = 1e-18;
  double parameter_tolerance = 1e-12;

  // If not empty, a file that holds how far the fit has got, from its start on and then
  // after every accepted iteration, see checkpoint.h.
  std::string checkpoint_path;
  // If not empty, the checkpoint from which to continue; where to start is then not
  // looked for again. max_seconds is for this run alone.
  std::string resume_path;

  // If set, receives where the time of rollouts and derivative passes went.
  Timings* timings = nullptr;

  std::function<void(const IterationReport&)> progress;
  // Polled between and within rollouts; true stops the fit with the best so far.
  std::function<bool()> interrupted;
};

enum class Termination {
  kConverged,      // the result is usable
  kMaxIterations,  // stopped before converging, best so far
  kMaxSeconds,
  kInterrupted,
  kStartFailed,      // the rollout of the starting point failed
  kNumericalFailure  // the optimiser could not go on
};

DPE_ESTIMATION_API std::string TerminationName(
    Termination termination);  // "converged", ...

// One estimated block, expanded to the object's elements.
struct EstimatedBlock {
  int object = -1;
  int capture = -1;  // whose alone it is, from 0; -1: all captures'
  std::string kind;  // "mass", ...
  char mode = 'G';
  std::string unit;
  Eigen::VectorXd values;     // one per unknown of the block
  std::vector<int> elements;  // for mode L: the element of each value
  std::vector<int> inactive;  // elements without influence on the motion
};

// One weight that was tried for the smoothness priors whose weight is to be chosen. The
// fit sees the first 80 % of the frames; the weight that predicts the others best is
// taken for the fit to all of them.
struct SmoothnessCandidate {
  double weight = 0.0;
  double training_cost = 0.0;  // 1/2 sum of squared residuals, without priors
  double held_out_cost = 0.0;  // likewise, of the frames that the fit did not see
  double held_out_rms = 0.0;   // m
  int iterations = 0;
  bool is_chosen = false;
  std::string message;  // why the held-out cost is infinite
};

// One motion that was captured: the scene in which it was, and what was seen of it.
struct CapturedMotion {
  Scene scene;
  Observations observations;
  std::string name;  // in messages, file names say; empty: "capture 1", ...
};

// What a fit says of one of its captures.
struct CaptureSummary {
  Scene scene;  // the capture's, with the estimated values in it
  int num_frames = 0;
  double final_rms = 0.0;  // m, of this capture alone
  MotionSensitivity sensitivity;
};

struct EstimatorSummary {
  Termination termination = Termination::kNumericalFailure;
  std::string message;             // one sentence: why it stopped
  std::string solver;              // "lm" or "lbfgs"
  std::string solver_reason;       // why this one
  std::string jacobian;            // "tangent", "adjoint", or "gradient" for L-BFGS
  std::string init;                // the method that gave the start
  std::vector<std::string> notes;  // gauges fixed, values clamped, ...
  // Iterations and time include those before the checkpoint that was resumed from.
  int iterations = 0;
  int evaluations = 0;           // rollouts
  int jacobian_evaluations = 0;  // derivative passes
  double wall_time_s = 0.0;
  double initial_cost = 0.0;  // 1/2 sum of squared residuals, see PositionCost
  double final_cost = 0.0;
  double prior_cost = 0.0;   // the part of it that priors have
  double initial_rms = 0.0;  // m
  double final_rms = 0.0;
  int num_frames = 0;                       // of the longest capture
  std::vector<HorizonStage> horizons;       // empty: all frames at once
  std::vector<SmoothnessPrior> smoothness;  // with the weights that were used
  std::vector<SmoothnessCandidate> smoothness_candidates;  // strongest first
  Eigen::VectorXd parameters;  // order of the (joint) layout, SI units
  std::vector<EstimatedBlock> blocks;
  Scene scene;  // the (first) input scene with the estimated values in it
  std::vector<CaptureSummary> captures;  // in the order in which they were given
  // Not ok, with a message, where none was computed.
  Uncertainty uncertainty;
  // Of the fitted motion that depends the most on its start; left out with
  // UncertaintyMode::kOff and where the fit was stopped.
  MotionSensitivity sensitivity;

  bool usable() const { return termination == Termination::kConverged; }
};

// Estimates the parameters that `scene` marks as estimated (optimizationSettings,
// `estimate`) from `observations`. The scene's values of estimated parameters are not
// used, except by InitMethod::kScene; where mass and stiffness are both estimated and
// no known force fixes their scale, the object's total mass is (and a note says so).
//
// @throws SceneError if nothing is estimated or observed, an option does not fit, or
// the
//         checkpoint to resume from cannot be read or is of another fit.
DPE_ESTIMATION_API EstimatorSummary Estimate(const Scene& scene,
                                             const Observations& observations,
                                             const EstimatorOptions& options);

// Estimates from several captures of the same cloths at once: each is a rollout of its
// own, in parallel (num_threads), and the cost is the sum of theirs.
//
// What the cloths are made of - mass, stiffness, damping, drag - is one set of
// parameters for all; initial velocities and positions are each capture's own, and so
// is a wind that is estimated. Captures may differ in everything else that a scene says
// (initial state, pins, wind, gravity, colliders, time steps) and in the number of
// frames; num_frames is the most that are fitted of each. A mass that is fixed in one
// and free in another is what the other says. A known force in any of them fixes the
// scale of mass and stiffness.
//
// @throws SceneError as above, naming the captures, if they are not of the same cloths
//         (RequireSameCloths), the noise of only some is known, one shows nothing that
//         a parameter moves, or they give two masses where the mass is kept
DPE_ESTIMATION_API EstimatorSummary
Estimate(const std::vector<CapturedMotion>& captures, const EstimatorOptions& options);

// The parameters that the scenes of a fit's captures, or of its only one, hold.
struct TrueParameters {
  Eigen::VectorXd values;  // as EstimatorSummary::parameters
  // One per block: whether it can represent what the scenes say. Only then is there a
  // deviation from it.
  std::vector<char> is_known;
};
DPE_ESTIMATION_API TrueParameters
TrueParametersOf(const std::vector<const Scene*>& truths);

// Mean over the parameters that act on the motion of 100 |p - p_true| / |p_true|; NaN
// if no block of the layout can represent the truth.
DPE_ESTIMATION_API double ParameterDeviationPercent(const EstimatorSummary& summary,
                                                    const Scene& truth);
DPE_ESTIMATION_API double ParameterDeviationPercent(
    const EstimatorSummary& summary, const std::vector<const Scene*>& truths);

}  // namespace dpe

#endif  // DPE_ESTIMATION_ESTIMATOR_H_
