#include "dpe/estimation/estimator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <sstream>

#include "dpe/engine/parameters.h"
#include "dpe/estimation/trajectory_problem.h"
#include "optimizers.h"
#include "starting_point.h"
#include "stop_control.h"
#include "summary_blocks.h"

namespace dpe {
namespace {

// The scene without its values of what is estimated, so that nothing that is computed
// from it can know them.
Scene WithoutEstimatedValues(const Scene& scene) {
  const ParameterLayout layout(scene);
  Eigen::VectorXd neutral = Eigen::VectorXd::Zero(layout.size());
  for (const ParameterBlock& block : layout.blocks()) {
    if (!ParameterKindIsPositive(block.kind)) continue;
    neutral.segment(block.offset, block.size).setOnes();
  }
  Scene blank = scene;
  layout.Insert(neutral, &blank);
  return blank;
}

int NumFramesToFit(const Scene& scene, const Observations& observations,
                   const EstimatorOptions& options) {
  if (ParameterLayout(scene).size() == 0) {
    throw SceneError(
        "nothing is estimated: set the scene's optimizationSettings or --settings "
        "(mass and stiffness: n, G, L or R per object) or its `estimate` object");
  }
  if (observations.positions.size() > scene.objects.size()) {
    throw SceneError("the observations hold " +
                     std::to_string(observations.positions.size()) +
                     " objects, the scene " + std::to_string(scene.objects.size()));
  }
  const int observed = observations.num_frames();
  if (options.num_frames > observed) {
    throw SceneError("frames to fit: " + std::to_string(options.num_frames) +
                     " asked for, " + std::to_string(observed) + " observed");
  }
  const int frames = options.num_frames > 0 ? options.num_frames : observed;
  if (frames < 2) {
    throw SceneError("frames to fit: " + std::to_string(frames) +
                     "; accepted are 2 or more (frame 0 is the initial state)");
  }
  return frames;
}

// Observations of what no parameter moves: fixed vertices and frame 0.
Observations WithoutFreeVertices(const Scene& scene, Observations observations) {
  for (size_t object = 0; object < observations.positions.size(); ++object) {
    Eigen::MatrixXd& positions = observations.positions[object];
    for (int v = 0; v < positions.rows() / 3; ++v) {
      if (scene.objects[object].is_fixed[v]) continue;
      positions.block(3 * v, 1, 3, positions.cols() - 1)
          .setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  }
  return observations;
}

Observations FirstFrames(const Observations& observations, int num_frames) {
  Observations first;
  for (const Eigen::MatrixXd& p : observations.positions) {
    first.positions.push_back(p.size() > 0 ? p.leftCols(num_frames).eval() : p);
  }
  return first;
}

class Fit {
 public:
  Fit(const Scene& scene, const Observations& observations,
      const EstimatorOptions& options)
      : scene_(scene),
        options_(options),
        num_frames_(NumFramesToFit(scene, observations, options)),
        observations_(FirstFrames(observations, num_frames_)),
        stop_(options.max_seconds, options.interrupted) {
    const Scene blank = WithoutEstimatedValues(scene);
    TrajectoryCosts costs = MakePositionCosts(blank, observations_, num_frames_);
    if (costs.empty()) {
      throw SceneError(
          "no free vertex of an estimated object is observed after frame 0");
    }
    TrajectoryEvaluatorOptions evaluator_options;
    evaluator_options.jacobian = options.jacobian;
    evaluator_options.num_threads = options.num_threads;
    evaluator_options.interrupted = [this] { return stop_.Poll(); };
    problem_ =
        std::make_unique<TrajectoryProblem>(blank, std::move(costs), evaluator_options);
    CountObservations();
    context_.problem = problem_.get();
    context_.options = &options_;
    context_.stop = &stop_;
    context_.converged_cost = 0.5 * Square(options.rms_tolerance) * num_positions_;
    context_.rms_of_cost = [this](double cost) { return Rms(cost); };
  }

  EstimatorSummary Run() {
    summary_.num_frames = num_frames_;
    ChooseSolver();
    if (Start()) Optimise();
    Finish();
    return summary_;
  }

 private:
  static double Square(double value) { return value * value; }

  TrajectoryEvaluator* evaluator() { return problem_->evaluator(); }

  double Rms(double cost) const {
    return std::sqrt((2.0 * cost + constant_square_sum_) / num_positions_);
  }

  // What the RMS counts beside the residuals: vertices that no parameter moves.
  void CountObservations() {
    num_positions_ = 0;
    for (int object = 0; object < static_cast<int>(scene_.objects.size()); ++object) {
      if (evaluator()->simulator()->is_simulated(object)) {
        num_positions_ += observations_.NumObserved(object);
      }
    }
    // Fixed vertices move as prescribed whatever the parameters are, which one frame
    // more than the initial state shows; a path is followed exactly.
    Trajectory still;
    for (size_t object = 0; object < scene_.objects.size(); ++object) {
      still.positions.push_back(PrescribedPositions(static_cast<int>(object)));
    }
    const Observations fixed = WithoutFreeVertices(scene_, observations_);
    const double rms = RmsPositionError(still, fixed, num_frames_);
    long count = 0;
    for (int object = 0; object < static_cast<int>(scene_.objects.size()); ++object) {
      if (still.positions[object].size() > 0) count += fixed.NumObserved(object);
    }
    constant_square_sum_ = count > 0 ? Square(rms) * count : 0.0;
  }

  // The initial state, held, with fixed vertices on their paths; 0 x 0 for objects that
  // are not simulated.
  Eigen::MatrixXd PrescribedPositions(int object) {
    if (!evaluator()->simulator()->is_simulated(object)) return {};
    const ClothObject& cloth = scene_.objects[object];
    Eigen::MatrixXd positions = cloth.positions.replicate(1, num_frames_);
    for (const PrescribedPath& path : cloth.prescribed_paths) {
      const int last = static_cast<int>(path.positions.cols()) - 1;
      for (int f = 1; f < num_frames_; ++f) {
        positions.col(f).segment<3>(3 * path.vertex) =
            path.positions.col(std::min(f, last));
      }
    }
    return positions;
  }

  void ChooseSolver() {
    const double bytes = 8.0 * evaluator()->num_residuals() *
                         static_cast<double>(evaluator()->num_parameters());
    const bool fits = bytes <= options_.max_lm_jacobian_bytes;
    std::ostringstream reason;
    reason.precision(3);
    if (options_.solver == SolverType::kAuto) {
      use_lm_ = fits;
      reason << "auto: the Jacobian of " << evaluator()->num_residuals()
             << " residuals by " << evaluator()->num_parameters()
             << " parameters takes " << bytes / 1e6 << " MB, "
             << (fits ? "within" : "above") << " the limit of "
             << options_.max_lm_jacobian_bytes / 1e6 << " MB for LM";
    } else {
      use_lm_ = options_.solver == SolverType::kLevenbergMarquardt;
      reason << "asked for";
    }
    summary_.solver = use_lm_ ? "lm" : "lbfgs";
    summary_.solver_reason = reason.str();
  }

  bool Start() {
    StartingPoint start =
        FindStartingPoint(scene_, observations_, options_, &stop_, evaluator());
    summary_.init = start.init;
    summary_.notes = start.notes;
    if (start.ok) {
      Perturb(&start.coordinates);
      NormaliseStart(&start.coordinates);
      problem_->set_coordinates(start.coordinates);
      start.ok = evaluator()->Evaluate(start.coordinates);
      start.message = evaluator()->message();
    }
    if (start.ok) {
      summary_.initial_cost = evaluator()->cost();
      summary_.initial_rms = Rms(summary_.initial_cost);
      summary_.jacobian = use_lm_ ? evaluator()->JacobianMethodName() : "gradient";
      return true;
    }
    if (stop_.stopped()) {
      summary_.termination = stop_.was_interrupted() ? Termination::kInterrupted
                                                     : Termination::kMaxSeconds;
      summary_.message = "stopped before the starting point was simulated";
    } else {
      summary_.termination = Termination::kStartFailed;
      summary_.message = "the starting point (" + start.init +
                         ") cannot be simulated: " + start.message +
                         "; try --init=screen, which looks for one that can";
    }
    return false;
  }

  void Perturb(Eigen::VectorXd* coordinates) {
    if (options_.init_perturbation == 0.0) return;
    std::mt19937_64 generator(options_.seed);
    std::normal_distribution<double> normal;
    Eigen::VectorXd parameters = evaluator()->map().ToParameters(*coordinates);
    for (double& value : parameters) {
      value *= std::exp(options_.init_perturbation * normal(generator));
    }
    *coordinates = evaluator()->map().ToCoordinates(parameters);
  }

  void NormaliseStart(Eigen::VectorXd* coordinates) {
    if (summary_.init == "inverse_dynamics" && options_.init_perturbation == 0.0)
      return;
    Eigen::VectorXd parameters = evaluator()->map().ToParameters(*coordinates);
    const std::vector<std::string> notes =
        NormaliseScale(scene_, problem_->layout(), FreeMass(scene_), &parameters);
    if (notes.empty()) return;
    if (summary_.init != "inverse_dynamics") {
      summary_.notes.insert(summary_.notes.end(), notes.begin(), notes.end());
    }
    *coordinates = evaluator()->map().ToCoordinates(parameters);
  }

  void Optimise() {
    if (evaluator()->cost() <= context_.converged_cost) {
      IterationReport report;
      report.cost = evaluator()->cost();
      context_.Report(report);
      summary_.termination = Termination::kConverged;
      summary_.message =
          "the starting point is the answer to the level of rounding (rms_tolerance)";
      return;
    }
    const OptimizerResult result =
        use_lm_ ? MinimizeByLevenbergMarquardt(&context_) : MinimizeByLbfgs(&context_);
    summary_.termination = result.termination;
    summary_.message = result.message;
  }

  void Finish() {
    const Eigen::VectorXd coordinates = evaluator()->best_coordinates().size() > 0
                                            ? evaluator()->best_coordinates()
                                            : problem_->coordinates();
    summary_.parameters = evaluator()->map().ToParameters(coordinates);
    summary_.final_cost = evaluator()->best_cost();
    summary_.final_rms = Rms(summary_.final_cost);
    if (!std::isfinite(summary_.final_cost)) {
      summary_.initial_cost = summary_.initial_rms = summary_.final_rms =
          summary_.final_cost = std::numeric_limits<double>::quiet_NaN();
    }
    summary_.iterations = context_.num_iterations;
    summary_.evaluations = evaluator()->num_rollouts();
    summary_.jacobian_evaluations = evaluator()->num_derivative_passes();
    summary_.scene = scene_;
    problem_->layout().Insert(summary_.parameters, &summary_.scene);
    summary_.blocks = MakeEstimatedBlocks(problem_->layout(), summary_.parameters);
    summary_.wall_time_s = stop_.Seconds();
  }

  const Scene& scene_;
  const EstimatorOptions options_;
  const int num_frames_;
  const Observations observations_;
  StopControl stop_;
  std::unique_ptr<TrajectoryProblem> problem_;
  OptimizerContext context_;
  EstimatorSummary summary_;
  bool use_lm_ = true;
  double num_positions_ = 0;          // that the RMS counts
  double constant_square_sum_ = 0.0;  // m^2, of vertices that no parameter moves
};

}  // namespace

EstimatorSummary Estimate(const Scene& scene, const Observations& observations,
                          const EstimatorOptions& options) {
  return Fit(scene, observations, options).Run();
}

}  // namespace dpe
