#include "derivatives/gradient_pass.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "integrators/integrator.h"

namespace dpe {
namespace {

// Fixed vertices' entries of an adjoint carry no meaning.
bool IsFiniteAtFree(const ObjectSystem& system, const Eigen::VectorXd& g) {
  for (int i : system.free_vertices()) {
    for (int k = 3 * i; k < 3 * i + 3; ++k) {
      if (!std::isfinite(g[k])) return false;
    }
  }
  return true;
}

}  // namespace

PassOutcome ObjectGradient(const ObjectRecord& record, const Eigen::MatrixXd& dl_dx,
                           const Eigen::MatrixXd& dl_dv, Eigen::VectorXd* gradient) {
  ObjectSystem* system = record.system;
  const int n = system->num_coordinates();
  const int steps_per_frame = record.scene->steps_per_frame;
  const int last_frame = static_cast<int>(std::max(dl_dx.cols(), dl_dv.cols())) - 1;
  Eigen::VectorXd gx = Eigen::VectorXd::Zero(n), gv = Eigen::VectorXd::Zero(n);
  gradient->setZero(system->columns().used().size());
  const auto add_seed = [&](int frame) {
    if (frame < dl_dx.cols()) gx += dl_dx.col(frame);
    if (frame < dl_dv.cols()) gv += dl_dv.col(frame);
  };
  const std::unique_ptr<Integrator> integrator =
      MakeIntegrator(record.scene->integration_method, *record.options);
  StepReader reader(record);
  StepStates states;
  const auto& kept = record.tape->factors;
  StepSolver* const solver = system->solver();
  add_seed(last_frame);
  for (int s = last_frame * steps_per_frame - 1; s >= 0; --s) {
    StepOutcome outcome = reader.Read(s, &states);
    if (!outcome.ok()) return {std::move(outcome), s};
    if (s < static_cast<int>(kept.size())) {
      solver->UseFactor(kept[s].get(), system->IsSymmetric());
    } else {
      solver->Reset();
    }
    Prefetch next;
    if (s > 0 && s <= static_cast<int>(kept.size())) next = kept[s - 1]->Prefetched();
    states.meanwhile = &next;
    if (!integrator->AdjointStep(system, solver, states,
                                 {gx.data(), gv.data(), gradient->data()})) {
      return {
          UnsolvedStep(integrator->FailedWithFiniteRightSide(), /*transposed=*/true),
          s};
    }
    if (s % steps_per_frame == 0) {
      if (!gradient->allFinite() || !IsFiniteAtFree(*system, gx) ||
          !IsFiniteAtFree(*system, gv)) {
        return {{RolloutStatus::Code::kNotFinite, ""}, s};
      }
      add_seed(s / steps_per_frame);
    }
  }
  const ParameterColumns& local = system->local_columns();
  for (int c = 0; c < n; ++c) {
    const int of_x = local.Column(ParameterKind::kInitialPosition, c);
    if (of_x >= 0) (*gradient)[of_x] += gx[c];
    const int of_v = local.Column(ParameterKind::kInitialVelocity, c);
    if (of_v >= 0) (*gradient)[of_v] += gv[c];
  }
  if (!gradient->allFinite()) return {{RolloutStatus::Code::kNotFinite, ""}, 0};
  return {};
}

}  // namespace dpe
