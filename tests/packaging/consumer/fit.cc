// Recovers a stiffness from a simulated motion: once by the library's own residuals,
// once through a residual that is written, and differentiated by Ceres, in this
// project.
#include <dpe/engine/cloth_builder.h>
#include <dpe/engine/simulator.h>
#include <dpe/estimation/autodiff_trajectory_cost.h>
#include <dpe/estimation/estimator.h>
#include <dpe/estimation/trajectory_problem.h>

#include <cmath>
#include <cstdio>

namespace {

constexpr int kFrames = 20;
constexpr double kStiffness = 30.0;  // N/m

dpe::Scene MakeScene() {
  dpe::PresetOptions options;
  options.rows = options.cols = 5;
  dpe::Scene scene = dpe::MakePresetScene(dpe::ScenePreset::kSide, options);
  scene.num_frames = kFrames;
  scene.objects[0].stiffness.setConstant(kStiffness);
  dpe::ApplySettings("nG", &scene);
  return scene;
}

bool IsNear(double value, const char* how) {
  const double error = std::abs(value / kStiffness - 1.0);
  std::printf("%s: stiffness %.9f N/m, relative error %.1e\n", how, value, error);
  return error < 1e-6;
}

bool FitsByTheEstimator(const dpe::Scene& scene, const dpe::Trajectory& motion) {
  dpe::EstimatorOptions options;
  options.init = dpe::InitMethod::kUniform;
  options.uniform_value = 10.0;
  const dpe::EstimatorSummary summary =
      dpe::Estimate(scene, dpe::ObserveAll(motion), options);
  return summary.usable() && IsNear(summary.parameters[0], "estimator");
}

// The distance of one vertex from where it was seen.
struct Seen {
  Eigen::Vector3d position;
  template <typename T>
  bool operator()(const T* x, T* residual) const {
    for (int c = 0; c < 3; ++c) residual[c] = x[c] - T(position[c]);
    return true;
  }
};

bool FitsByOwnResidual(const dpe::Scene& scene, const dpe::Trajectory& motion) {
  int vertex = scene.objects[0].num_vertices() - 1;
  while (scene.objects[0].is_fixed[vertex]) --vertex;
  dpe::TrajectoryCosts costs;
  for (int frame = 1; frame < kFrames; ++frame) {
    const Seen seen{motion.positions[0].col(frame).segment<3>(3 * vertex)};
    costs.push_back(dpe::MakeAutodiffCost<3, 1>(scene, seen, {{0, frame, {vertex}}}));
  }
  dpe::TrajectoryProblem problem(scene, std::move(costs));
  problem.set_coordinates(Eigen::VectorXd::Constant(1, std::log(20.0)));
  ceres::Solver::Options options;
  options.function_tolerance = options.parameter_tolerance = 1e-14;
  options.gradient_tolerance = 1e-18;
  ceres::Solver::Summary summary;
  ceres::Solve(options, problem.least_squares(), &summary);
  return summary.IsSolutionUsable() &&
         IsNear(std::exp(problem.coordinates()[0]), "own residual");
}

}  // namespace

int main() {
  const dpe::Scene scene = MakeScene();
  const dpe::Trajectory motion = dpe::Simulator(scene).Simulate(kFrames);
  const bool ok = FitsByTheEstimator(scene, motion) & FitsByOwnResidual(scene, motion);
  return ok ? 0 : 1;
}
