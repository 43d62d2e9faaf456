#include "frame_runner.h"

#include <algorithm>

namespace dpe {
namespace {

// Beyond this a rollout counts as diverged, long before overflow, m.
constexpr double kMaxCoordinate = 1e12;

bool InRange(const Eigen::Ref<const Eigen::VectorXd>& x) {
  return x.allFinite() && x.cwiseAbs().maxCoeff() < kMaxCoordinate;
}

}  // namespace

FrameRunner::FrameRunner(const Scene& scene, const SimulatorOptions& options,
                         ObjectSystem* system)
    : scene_(scene),
      options_(options),
      system_(system),
      integrator_(MakeIntegrator(scene.integration_method, options)),
      v0_(system->num_coordinates()) {}

StepOutcome FrameRunner::Run(int frame, int num_steps, const FrameTarget& target,
                             const std::vector<std::unique_ptr<KeptFactor>>& kept,
                             int* failed_step) {
  InnerStates* inner = target.inner;
  const int slot = target.inner_frame;
  // A pass may begin at this checkpoint: what a step remembers of earlier ones must not
  // depend on whether they came just before.
  if (HasInnerStates()) integrator_->ForgetSteps();
  for (int k = 0; k < num_steps; ++k) {
    const bool is_last = k == scene_.steps_per_frame - 1;
    const int s = frame * scene_.steps_per_frame + k;
    StepResult result;
    result.x1 = is_last ? target.x1 : inner->x(slot, k + 1);
    result.v1 = is_last ? target.v1 : inner->v(slot, k + 1);
    if (num_stages() > 1) {
      result.xs = inner->xs(slot, k);
      result.vs = inner->vs(slot, k);
    }
    StepSolver* const solver = system_->solver();
    solver->KeepFactorsIn(s < static_cast<int>(kept.size()) ? kept[s].get() : nullptr);
    const StepOutcome outcome = Step(s, k == 0 ? target.x0 : inner->x(slot, k),
                                     k == 0 ? target.v0 : inner->v(slot, k), result);
    solver->KeepFactorsIn(nullptr);
    if (!outcome.ok()) {
      *failed_step = k;
      return outcome;
    }
  }
  return {};
}

StepOutcome FrameRunner::Step(int step, const double* x0, const double* v0,
                              const StepResult& result) {
  if (options_.interrupted && options_.interrupted()) {
    return {RolloutStatus::Code::kInterrupted, ""};
  }
  const double h = scene_.step_length();
  const int n = system_->num_coordinates();
  Eigen::Map<Eigen::VectorXd> x1(result.x1, n), v1(result.v1, n);
  std::copy_n(x0, n, result.x1);
  system_->SetPrescribedPositions(step + 1, result.x1);
  std::copy_n(v0, n, v0_.data());
  system_->SetPrescribedVelocities(h, x0, result.x1, v0_.data());
  v1 = v0_;
  StepOutcome outcome = integrator_->Step(
      system_, system_->solver(),
      {h, x0, v0_.data(), result.x1, result.v1, result.xs, result.vs}, result);
  if (outcome.ok() && !(InRange(x1) && v1.allFinite())) {
    outcome.code = RolloutStatus::Code::kNotFinite;
    outcome.reason = integrator_->DivergenceReason();
  }
  if (!outcome.ok()) NameUndefinedForce(x0, result, &outcome);
  return outcome;
}

// Whatever a step ends with that met a force without a value, that is the reason. The
// states that it has met: the one before, and those that it was about to reach.
void FrameRunner::NameUndefinedForce(const double* x0, const StepResult& result,
                                     StepOutcome* outcome) const {
  for (const double* x : {x0, static_cast<const double*>(result.xs),
                          static_cast<const double*>(result.x1)}) {
    if (x == nullptr) continue;
    const std::string reason = system_->UndefinedReason(x);
    if (reason.empty()) continue;
    outcome->code = RolloutStatus::Code::kNotFinite;
    outcome->reason = reason;
    return;
  }
}

}  // namespace dpe
