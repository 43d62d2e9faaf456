#include "derivatives/gradient_pass.h"

#include <algorithm>
#include <vector>

#include "integrators/integrator.h"

namespace dpe {

bool ObjectGradient(const ObjectRecord& record, const Eigen::MatrixXd& dl_dx,
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
    if (!reader.Read(s, &states)) return false;
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
      return false;
    }
    if (s % steps_per_frame == 0) add_seed(s / steps_per_frame);
  }
  const ParameterColumns& local = system->local_columns();
  for (int c = 0; c < n; ++c) {
    const int of_x = local.Column(ParameterKind::kInitialPosition, c);
    if (of_x >= 0) (*gradient)[of_x] += gx[c];
    const int of_v = local.Column(ParameterKind::kInitialVelocity, c);
    if (of_v >= 0) (*gradient)[of_v] += gv[c];
  }
  return true;
}

}  // namespace dpe
