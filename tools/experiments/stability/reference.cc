#include "experiments/stability/reference.h"

#include <algorithm>
#include <cmath>

#include "dpe/engine/simulator.h"

namespace dpe::experiments {
namespace {

// Counted in steps, not in seconds, so that a cell's result is the same everywhere.
constexpr int kImplicitSteps = 25600;
constexpr int kExplicitSteps = 409600;

Eigen::MatrixXd Simulated(Scene scene, IntegrationMethod method, int refinement,
                          int num_frames) {
  scene.integration_method = method;
  scene.solver = "cholesky";
  scene.steps_per_frame *= refinement;
  const Trajectory trajectory = Simulator(scene).Simulate(num_frames);
  if (!trajectory.status.ok()) return {};
  return trajectory.positions[0];
}

// @param max_steps  of the finest rollout
Reference Refine(const Scene& scene, int num_frames, double tolerance,
                 IntegrationMethod method, int max_steps) {
  Reference reference;
  reference.method = method;
  const int steps = (num_frames - 1) * scene.steps_per_frame;
  const int finest = std::max(max_steps / steps, 8);
  Eigen::MatrixXd before;
  for (int refinement = 4; refinement <= finest; refinement *= 2) {
    Eigen::MatrixXd now = Simulated(scene, method, refinement, num_frames);
    if (now.size() > 0 && before.size() > 0) {
      const ClothObject& object = scene.objects[0];
      reference.available = true;
      reference.refinement = refinement;
      reference.error = RmsDifference(object, now, before);
      reference.motion =
          RmsDifference(object, now, object.positions.replicate(1, num_frames));
      reference.positions = now;
      reference.converged = reference.error <= tolerance * reference.motion;
      if (reference.converged) break;
    }
    before = std::move(now);
  }
  return reference;
}

}  // namespace

double RmsDifference(const ClothObject& object, const Eigen::MatrixXd& a,
                     const Eigen::MatrixXd& b) {
  double sum = 0.0;
  int count = 0;
  for (int i = 0; i < object.num_vertices(); ++i) {
    if (object.is_fixed[i]) continue;
    sum += (a.middleRows<3>(3 * i) - b.middleRows<3>(3 * i)).squaredNorm();
    ++count;
  }
  return std::sqrt(sum / (static_cast<double>(count) * a.cols()));
}

Reference ComputeReference(const Scene& scene, int num_frames, double tolerance) {
  const Reference implicit =
      Refine(scene, num_frames, tolerance, IntegrationMethod::kTrBdf2, kImplicitSteps);
  if (implicit.converged) return implicit;
  const Reference symplectic =
      Refine(scene, num_frames, tolerance, IntegrationMethod::kSymplecticEuler,
             kExplicitSteps);
  if (!symplectic.available) return implicit;
  const bool is_better = !implicit.available || symplectic.error / symplectic.motion <
                                                    implicit.error / implicit.motion;
  return is_better ? symplectic : implicit;
}

}  // namespace dpe::experiments
