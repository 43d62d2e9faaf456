#include "derivatives/gradient_pass.h"

#include <algorithm>
#include <vector>

#include "integrators/integrator.h"

namespace dpe {

bool AddObjectGradient(const Scene& scene, const SimulatorOptions& options,
                       ObjectSystem* system, const ObjectTape& tape,
                       const Eigen::MatrixXd& dl_dx, const Eigen::MatrixXd& dl_dv,
                       Eigen::VectorXd* gradient) {
  const int n = system->num_coordinates();
  const double h = scene.step_length();
  const int last_frame = static_cast<int>(std::max(dl_dx.cols(), dl_dv.cols())) - 1;
  const std::vector<int>& columns = system->columns().used();
  Eigen::VectorXd gx = Eigen::VectorXd::Zero(n), gv = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd gp = Eigen::VectorXd::Zero(columns.size());
  const auto add_seed = [&](int frame) {
    if (frame < dl_dx.cols()) gx += dl_dx.col(frame);
    if (frame < dl_dv.cols()) gv += dl_dv.col(frame);
  };
  const std::unique_ptr<Integrator> integrator =
      MakeIntegrator(scene.integration_method, options);
  Eigen::VectorXd v0(n);
  add_seed(last_frame);
  for (int s = last_frame * scene.steps_per_frame - 1; s >= 0; --s) {
    const StepStates states = StatesOfStep(*system, tape, s, h, &v0);
    StepSolver* solver = system->solver();
    if (s < static_cast<int>(tape.solvers.size())) {
      solver = tape.solvers[s].get();
    } else {
      solver->Reset();
    }
    if (!integrator->AdjointStep(system, solver, states,
                                 {gx.data(), gv.data(), gp.data()})) {
      return false;
    }
    if (s % scene.steps_per_frame == 0) add_seed(s / scene.steps_per_frame);
  }
  const ParameterColumns& local = system->local_columns();
  if (local.Has(ParameterKind::kInitialVelocity)) {
    for (int c = 0; c < n; ++c) {
      const int column = local.Column(ParameterKind::kInitialVelocity, c);
      if (column >= 0) gp[column] += gv[c];
    }
  }
  for (size_t k = 0; k < columns.size(); ++k) (*gradient)[columns[k]] += gp[k];
  return true;
}

}  // namespace dpe
