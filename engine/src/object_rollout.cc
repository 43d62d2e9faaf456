#include "object_rollout.h"

#include <limits>

#include "frame_runner.h"

namespace dpe {
namespace {

void MakeRoomForFactors(const MemoryPlan& plan, const ObjectSystem& system,
                        ObjectTape* tape) {
  if (plan.num_factors == 0) return;
  tape->bytes_per_factor = system.factor_bytes();
  tape->factors = tape->pool->Take(plan.num_factors, tape->bytes_per_factor);
  const int missing = plan.num_factors - static_cast<int>(tape->factors.size());
  for (auto& factor : system.MakeKeptFactors(missing)) {
    tape->factors.push_back(std::move(factor));
  }
}

}  // namespace

MemoryDemand DemandOf(const Scene& scene, const SimulatorOptions& options,
                      const ObjectSystem& system) {
  const auto integrator = MakeIntegrator(scene.integration_method, options);
  MemoryDemand demand;
  demand.bytes_per_frame = InnerStates::BytesPerFrame(
      system.num_coordinates(), scene.steps_per_frame, integrator->num_stages());
  if (integrator->LeavesAdjointFactor() && system.KeepingFactorsPays()) {
    demand.bytes_per_factor = system.factor_bytes();
  }
  return demand;
}

RolloutStatus RollOutObject(const Scene& scene, const SimulatorOptions& options,
                            int object, const MemoryPlan& plan, ObjectSystem* system,
                            ObjectTape* tape, Trajectory* trajectory) {
  const int n = system->num_coordinates();
  const int k = scene.steps_per_frame;
  FrameRunner runner(scene, options, system);
  ObjectTape nothing;
  if (tape == nullptr) {
    tape = &nothing;
  } else {
    tape->inner.Resize(n, k, runner.num_stages(), plan.num_inner_frames);
    MakeRoomForFactors(plan, *system, tape);
  }
  InnerStates passing;  // of a frame whose inner states are not kept
  passing.Resize(n, k, runner.num_stages(), 1);
  Eigen::MatrixXd& x = trajectory->positions[object];
  Eigen::MatrixXd& v = trajectory->velocities[object];
  x.col(0) = system->initial_positions();
  v.col(0) = system->initial_velocities();
  RolloutStatus status;
  status.object = object;
  for (int f = 0; f + 1 < x.cols(); ++f) {
    FrameTarget target{x.col(f).data(), v.col(f).data(), x.col(f + 1).data(),
                       v.col(f + 1).data(), &passing};
    if (f < tape->inner.num_frames()) {
      target.inner = &tape->inner;
      target.inner_frame = f;
    }
    const StepOutcome outcome = runner.Run(f, k, target, tape->factors, &status.step);
    if (!outcome.ok()) {
      status.code = outcome.code;
      status.reason = outcome.reason;
      status.frame = f + 1;
      x.col(f + 1).setConstant(std::numeric_limits<double>::quiet_NaN());
      v.col(f + 1).setConstant(std::numeric_limits<double>::quiet_NaN());
      return status;
    }
  }
  return status;
}

}  // namespace dpe
