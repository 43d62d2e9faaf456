#include "object_rollout.h"

#include <algorithm>
#include <memory>

#include "integrators/integrator.h"

namespace dpe {
namespace {

// Beyond this a rollout counts as diverged, long before overflow, m.
constexpr double kMaxCoordinate = 1e12;

bool InRange(const Eigen::Ref<const Eigen::VectorXd>& x) {
  return x.allFinite() && x.cwiseAbs().maxCoeff() < kMaxCoordinate;
}

class ObjectRollout {
 public:
  ObjectRollout(const Scene& scene, const SimulatorOptions& options,
                ObjectSystem* system, ObjectTape* tape)
      : scene_(scene),
        options_(options),
        system_(system),
        keeps_all_(tape != nullptr),
        tape_(keeps_all_ ? tape : &two_columns_),
        integrator_(MakeIntegrator(scene.integration_method, options)),
        v0_(system->num_coordinates()) {}

  // Allocates the tape and puts the initial state into its first column.
  void Start(int num_steps, size_t solver_bytes) {
    const int n = system_->num_coordinates();
    const int columns = keeps_all_ ? num_steps + 1 : 2;
    tape_->positions.resize(n, columns);
    tape_->velocities.resize(n, columns);
    tape_->positions.col(0) = system_->initial_positions();
    tape_->velocities.col(0) = system_->initial_velocities();
    if (integrator_->num_stages() > 1) {
      tape_->stage_positions.resize(n, columns - 1);
      tape_->stage_velocities.resize(n, columns - 1);
    }
    if (!keeps_all_ || !integrator_->UsesSolver()) return;
    const size_t count =
        std::min<size_t>(num_steps, solver_bytes / system_->solver_bytes());
    for (size_t s = 0; s < count; ++s) {
      tape_->solvers.push_back(tape_->pool->Take(*system_));
      tape_->solvers.back()->Reset();
    }
  }

  StepOutcome Step(int s) {
    if (options_.interrupted && options_.interrupted()) {
      return {RolloutStatus::Code::kInterrupted, ""};
    }
    const double h = scene_.step_length();
    const int stage = keeps_all_ ? s : 0;
    auto x0 = tape_->positions.col(Column(s));
    auto x1 = tape_->positions.col(Column(s + 1));
    auto v1 = tape_->velocities.col(Column(s + 1));
    x1 = x0;
    system_->SetPrescribedPositions(s + 1, x1.data());
    v0_ = tape_->velocities.col(Column(s));
    system_->SetPrescribedVelocities(h, x0.data(), x1.data(), v0_.data());
    v1 = v0_;
    StepResult result{x1.data(), v1.data(), nullptr, nullptr};
    if (integrator_->num_stages() > 1) {
      result.xs = tape_->stage_positions.col(stage).data();
      result.vs = tape_->stage_velocities.col(stage).data();
    }
    StepSolver* solver = s < static_cast<int>(tape_->solvers.size())
                             ? tape_->solvers[s].get()
                             : system_->solver();
    StepOutcome outcome = integrator_->Step(
        system_, solver,
        {h, x0.data(), v0_.data(), x1.data(), v1.data(), result.xs, result.vs}, result);
    if (outcome.ok() && !(InRange(x1) && v1.allFinite())) {
      outcome.code = RolloutStatus::Code::kNotFinite;
    }
    return outcome;
  }

  auto positions(int s) const { return tape_->positions.col(Column(s)); }
  auto velocities(int s) const { return tape_->velocities.col(Column(s)); }

 private:
  int Column(int s) const { return keeps_all_ ? s : s % 2; }

  const Scene& scene_;
  const SimulatorOptions& options_;
  ObjectSystem* system_;
  bool keeps_all_;
  ObjectTape two_columns_;  // where nothing is kept, two columns take turns
  ObjectTape* tape_;
  std::unique_ptr<Integrator> integrator_;
  Eigen::VectorXd v0_;
};

}  // namespace

RolloutStatus RollOutObject(const Scene& scene, const SimulatorOptions& options,
                            int object, int num_frames, size_t solver_bytes,
                            ObjectSystem* system, ObjectTape* tape,
                            Trajectory* trajectory) {
  const int num_steps = (num_frames - 1) * scene.steps_per_frame;
  ObjectRollout rollout(scene, options, system, tape);
  rollout.Start(num_steps, solver_bytes);
  trajectory->positions[object].col(0) = rollout.positions(0);
  trajectory->velocities[object].col(0) = rollout.velocities(0);
  RolloutStatus status;
  status.object = object;
  for (int s = 0; s < num_steps; ++s) {
    const int frame = s / scene.steps_per_frame + 1;
    const StepOutcome outcome = rollout.Step(s);
    if (!outcome.ok()) {
      status.code = outcome.code;
      status.reason = outcome.reason;
      status.frame = frame;
      status.step = s % scene.steps_per_frame;
      return status;
    }
    if ((s + 1) % scene.steps_per_frame == 0) {
      trajectory->positions[object].col(frame) = rollout.positions(s + 1);
      trajectory->velocities[object].col(frame) = rollout.velocities(s + 1);
    }
  }
  return status;
}

}  // namespace dpe
