#include "dpe/estimation/multiple_shooting.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "dpe/engine/parameters.h"
#include "dpe/engine/simulator.h"
#include "levenberg_marquardt.h"
#include "shooting_windows.h"

namespace dpe {
namespace {

// Above as many parameters their zeros are worth more than a QR factorisation's
// accuracy, which the polishing has anyway.
constexpr int kMaxDenseParameters = 400;

void CheckOptions(const MultipleShootingOptions& options, int num_frames) {
  const auto require = [](bool ok, const char* what) {
    if (!ok) throw SceneError(std::string("multiple shooting: ") + what);
  };
  require(num_frames >= 2, "accepted are 2 frames or more");
  require(options.window_frames >= 1, "a window has at least one frame length");
  require(options.first_weight > 0.0 && options.weight_factor > 1.0,
          "weights are positive and grow");
}

// The damping of a parameter that is optimised by its logarithm is at least that of a
// column of J as long as this fraction of the longest such one. Levenberg-Marquardt
// would otherwise let a parameter that has little influence jump by any factor; it is
// then lost, because it has none where it lands.
constexpr double kShortColumn = 1.0;

// The squared length of the longest column of a logarithm at the problem's coordinates.
double LongestColumn(TrajectoryProblem* problem) {
  TrajectoryEvaluator* evaluator = problem->evaluator();
  if (!evaluator->Evaluate(problem->coordinates()) || !evaluator->EvaluateJacobian()) {
    return 0.0;
  }
  const Eigen::VectorXd squares = evaluator->JacobianColumnSquares();
  double longest = 0.0;
  for (int i = 0; i < squares.size(); ++i) {
    if (evaluator->map().is_log(i)) longest = std::max(longest, squares[i]);
  }
  return longest;
}

bool IsInterrupted(const MultipleShootingOptions& options) {
  return options.evaluator.interrupted && options.evaluator.interrupted();
}

// Ends a solve at the cost that is enough, or when asked to.
class StopCallback : public ceres::IterationCallback {
 public:
  explicit StopCallback(const MultipleShootingOptions& options) : options_(options) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& s) override {
    if (s.iteration > 0 && options_.progress) {
      options_.progress(s.cost, s.step_norm, s.step_is_successful);
    }
    const bool stop = s.cost <= options_.converged_cost || IsInterrupted(options_);
    return stop ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  const MultipleShootingOptions& options_;
};

// Levenberg-Marquardt from the problem's coordinates, to the best point.
// @return the number of iterations
int Minimise(const MultipleShootingOptions& options, int max_iterations,
             double tolerance, TrajectoryProblem* problem) {
  TrajectoryEvaluator* evaluator = problem->evaluator();
  const Eigen::VectorXd start = problem->coordinates();
  ceres::Solver::Options solver = LevenbergMarquardtOptions();
  const bool is_joined = evaluator->num_segments() == 1;
  if (!is_joined) {
    if (evaluator->num_parameters() > kMaxDenseParameters) {
      solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    }
    solver.min_lm_diagonal = std::max(
        solver.min_lm_diagonal, kShortColumn * kShortColumn * LongestColumn(problem));
    solver.max_lm_diagonal = std::max(solver.max_lm_diagonal, solver.min_lm_diagonal);
    solver.jacobi_scaling = false;  // lengths of columns are to stay
  }
  solver.max_num_iterations = max_iterations;
  solver.function_tolerance = tolerance;
  solver.gradient_tolerance = 1e-18;
  solver.parameter_tolerance = 1e-12;
  // Ceres's sums would depend on the number of its threads; the work is in the
  // callback.
  solver.num_threads = 1;
  StopCallback stop(options);
  solver.callbacks.push_back(&stop);
  ceres::Solver::Summary summary;
  const std::unique_ptr<ceres::Problem> reduced = problem->NewReducedLeastSquares();
  ceres::Solve(solver, reduced ? reduced.get() : problem->least_squares(), &summary);
  // The point of least cost, which the evaluator's own best need not be: there may be
  // residuals that it does not know.
  if (!summary.IsSolutionUsable()) problem->set_coordinates(start);
  return std::max(0, static_cast<int>(summary.iterations.size()) - 1);
}

class Shooting {
 public:
  Shooting(const Scene& scene, const Observations& observations, int num_frames,
           const MultipleShootingOptions& options)
      : scene_(scene),
        observations_(observations),
        num_frames_(num_frames),
        options_(options),
        time_scale_(options.time_scale > 0.0 ? options.time_scale : scene.delta) {
    CheckOptions(options, num_frames);
    if (!options_.make_costs) {
      options_.make_costs = [](const Scene& s, const Observations& o, int frames) {
        return MakePositionCosts(s, o, frames);
      };
    }
  }

  MultipleShootingSummary Run(const Eigen::VectorXd& start) {
    summary_.parameters = start;
    MakeProblem(start);
    RaiseWeights();
    summary_.parameters = windows_problem_->evaluator()->joint_layout().Gather(
        windows_problem_->evaluator()->map().ToParameters(
            windows_problem_->coordinates()),
        0);
    windows_problem_.reset();
    Polish();
    return summary_;
  }

 private:
  Trajectory RollOut(const Eigen::VectorXd& parameters) const {
    SimulatorOptions options;
    options.only_estimated_objects = true;
    options.num_threads = options_.evaluator.num_threads;
    options.interrupted = options_.evaluator.interrupted;
    Scene scene = scene_;
    ParameterLayout(scene).Insert(parameters, &scene);
    return Simulator(scene, options).Simulate(num_frames_);
  }

  void MakeProblem(const Eigen::VectorXd& start) {
    if (ParameterLayout(scene_).size() == 0) {
      throw SceneError("multiple shooting: nothing is estimated");
    }
    const Trajectory rollout = RollOut(start);
    summary_.window_frames = options_.window_frames;
    CutAndStart(start, rollout);
    while (summary_.window_frames > 1 && !IsInterrupted(options_) &&
           !WindowsAreUsable()) {
      summary_.window_frames /= 2;
      CutAndStart(start, rollout);
    }
  }

  // Jumps longer than the cloth are those of a simulation that is about to blow up:
  // its derivatives say nothing.
  bool WindowsAreUsable() {
    SetWeights(options_.first_weight);
    if (!windows_problem_->evaluator()->Evaluate(windows_problem_->coordinates())) {
      return false;
    }
    MultipleShootingStage stage;
    MeasureJumps(options_.first_weight, &stage);
    double extent = 0.0;
    for (const ClothObject& cloth : scene_.objects) {
      const Eigen::Map<const Eigen::Matrix3Xd> points(cloth.positions.data(), 3,
                                                      cloth.num_vertices());
      extent = std::max(
          extent, (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm());
    }
    return stage.largest_jump <= extent;
  }

  void SetWeights(double weight) {
    TrajectoryEvaluator* evaluator = windows_problem_->evaluator();
    for (int k = 0; k < evaluator->num_links(); ++k) {
      evaluator->SetLinkWeights(k, weight, weight * time_scale_);
    }
  }

  void CutAndStart(const Eigen::VectorXd& start, const Trajectory& rollout) {
    const std::vector<ShootingWindow> windows = CutIntoWindows(
        scene_, observations_, rollout, num_frames_, summary_.window_frames);
    std::vector<TrajectorySegment> segments;
    std::vector<const Scene*> scenes;
    size_t num_costs = 0;
    for (const ShootingWindow& window : windows) {
      segments.push_back(
          {window.scene,
           options_.make_costs(window.scene, window.observations, window.num_frames)});
      scenes.push_back(&window.scene);
      num_costs += segments.back().costs.size();
    }
    if (num_costs == 0) throw SceneError("multiple shooting: nothing is observed");
    summary_.num_windows = static_cast<int>(windows.size());
    windows_problem_ = std::make_unique<TrajectoryProblem>(
        std::move(segments), LinkWindows(windows), options_.evaluator);
    if (options_.add_residuals) options_.add_residuals(windows_problem_.get());
    const TrajectoryEvaluator& evaluator = *windows_problem_->evaluator();
    const JointLayout& joint = evaluator.joint_layout();
    Eigen::VectorXd parameters = joint.Extract(scenes);
    for (int i = 0; i < start.size(); ++i) parameters[joint.indices(0)[i]] = start[i];
    windows_problem_->set_coordinates(evaluator.map().ToCoordinates(parameters));
  }

  void RaiseWeights() {
    TrajectoryEvaluator* evaluator = windows_problem_->evaluator();
    double weight = options_.first_weight;
    for (int stage = 0; stage < options_.max_stages && !summary_.joined; ++stage) {
      SetWeights(weight);
      MultipleShootingStage report;
      report.weight = weight;
      if (!evaluator->Evaluate(windows_problem_->coordinates())) {
        summary_.message = "the windows cannot be simulated: " + evaluator->message();
        return;
      }
      report.iterations = Minimise(options_, options_.max_iterations_per_stage,
                                   options_.stage_tolerance, windows_problem_.get());
      evaluator->Evaluate(windows_problem_->coordinates());
      MeasureJumps(weight, &report);
      summary_.stages.push_back(report);
      summary_.joined = report.largest_jump <= options_.continuity_tolerance;
      weight *= options_.weight_factor;
      if (IsInterrupted(options_)) {
        summary_.message = "interrupted";
        return;
      }
    }
  }

  void MeasureJumps(double weight, MultipleShootingStage* stage) const {
    const TrajectoryEvaluator& evaluator = *windows_problem_->evaluator();
    for (int cost = 0; cost < static_cast<int>(evaluator.costs().size()); ++cost) {
      const auto rows = evaluator.residuals().segment(
          evaluator.first_row(cost), evaluator.costs()[cost]->num_residuals());
      if (evaluator.LinkTarget(cost) < 0) {
        stage->data_cost += 0.5 * rows.squaredNorm();
      } else {
        stage->largest_jump =
            std::max(stage->largest_jump, rows.lpNorm<Eigen::Infinity>() / weight);
      }
    }
  }

  void Polish() {
    TrajectoryProblem problem(scene_,
                              options_.make_costs(scene_, observations_, num_frames_),
                              options_.evaluator);
    if (options_.add_residuals) options_.add_residuals(&problem);
    TrajectoryEvaluator* evaluator = problem.evaluator();
    problem.set_coordinates(evaluator->map().ToCoordinates(summary_.parameters));
    summary_.ok = evaluator->Evaluate(problem.coordinates());
    if (!summary_.ok) {
      const double nan = std::numeric_limits<double>::quiet_NaN();
      summary_.joined_cost = summary_.final_cost = nan;
      summary_.message = "a single rollout fails: " + evaluator->message();
      return;
    }
    summary_.joined_cost = evaluator->cost();
    if (options_.max_polish_iterations > 0) {
      summary_.polish_iterations =
          Minimise(options_, options_.max_polish_iterations, 1e-12, &problem);
    }
    evaluator->Evaluate(problem.coordinates());
    summary_.parameters = evaluator->map().ToParameters(problem.coordinates());
    summary_.final_cost = evaluator->cost();
    if (summary_.message.empty()) {
      summary_.message = summary_.joined
                             ? "the windows have been joined"
                             : "the windows' jumps are still above the tolerance";
    }
  }

  const Scene& scene_;
  const Observations& observations_;
  int num_frames_;
  MultipleShootingOptions options_;
  double time_scale_;
  std::unique_ptr<TrajectoryProblem> windows_problem_;
  MultipleShootingSummary summary_;
};

}  // namespace

MultipleShootingSummary MultipleShooting(const Scene& scene,
                                         const Observations& observations,
                                         int num_frames, const Eigen::VectorXd& start,
                                         const MultipleShootingOptions& options) {
  return Shooting(scene, observations, num_frames, options).Run(start);
}

}  // namespace dpe
