#include "dpe/engine/sensitivity.h"

#include <algorithm>

#include "derivatives/gradient_pass.h"
#include "derivatives/jacobian_pass.h"
#include "object_system.h"
#include "rollout_tape.h"

namespace dpe {

Sensitivity::Sensitivity(Simulator* simulator, const Rollout* rollout)
    : simulator_(simulator), rollout_(rollout) {
  if (simulator_->current_parameters_ != rollout_->parameters_) {
    simulator_->SetParameters(rollout_->parameters_);
  }
}

Eigen::VectorXd Sensitivity::Gradient(const std::vector<Eigen::MatrixXd>& dl_dx,
                                      const std::vector<Eigen::MatrixXd>& dl_dv) {
  const ScopedTimer timer(simulator_->options_.timings, TimedPart::kDerivatives);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(simulator_->layout().size());
  const Eigen::MatrixXd none;
  for (size_t o = 0; o < simulator_->systems_.size(); ++o) {
    if (!simulator_->systems_[o]) continue;
    const Eigen::MatrixXd& seed_x = o < dl_dx.size() ? dl_dx[o] : none;
    const Eigen::MatrixXd& seed_v = o < dl_dv.size() ? dl_dv[o] : none;
    if (seed_x.size() == 0 && seed_v.size() == 0) continue;
    ok_ &= AddObjectGradient(simulator_->scene_, simulator_->options_,
                             simulator_->systems_[o].get(), rollout_->tape_->objects[o],
                             seed_x, seed_v, &gradient);
  }
  return gradient;
}

void Sensitivity::JacobianVectorProduct(const Eigen::VectorXd& dp,
                                        std::vector<Eigen::MatrixXd>* dx,
                                        std::vector<Eigen::MatrixXd>* dv) {
  const ScopedTimer timer(simulator_->options_.timings, TimedPart::kDerivatives);
  const size_t num_objects = simulator_->systems_.size();
  dx->assign(num_objects, {});
  dv->assign(num_objects, {});
  for (size_t o = 0; o < num_objects; ++o) {
    if (!simulator_->systems_[o]) continue;
    const PassInput input{&simulator_->scene_,
                          &simulator_->options_,
                          simulator_->systems_[o].get(),
                          &rollout_->tape_->objects[o],
                          {}};
    ok_ &= PropagateTangent(input, dp, rollout_->trajectory().num_frames(), &(*dx)[o],
                            &(*dv)[o]);
  }
}

RowMajorMatrix Sensitivity::Jacobian(const std::vector<StateDerivative>& derivatives,
                                     int num_rows, JacobianMethod method) {
  RowMajorMatrix jacobian;
  Jacobian(derivatives, num_rows, method, &jacobian);
  return jacobian;
}

void Sensitivity::Jacobian(const std::vector<StateDerivative>& derivatives,
                           int num_rows, JacobianMethod method,
                           RowMajorMatrix* jacobian) {
  const ScopedTimer timer(simulator_->options_.timings, TimedPart::kDerivatives);
  if (method == JacobianMethod::kAuto) method = CheaperMethod(derivatives);
  // Zeros that are written, not fresh pages of the system: adding to those from several
  // threads means a fault per page that stops them all.
  jacobian->resize(num_rows, simulator_->layout().size());
  jacobian->setZero();

  for (size_t o = 0; o < simulator_->systems_.size(); ++o) {
    if (!simulator_->systems_[o]) continue;
    PassInput input{&simulator_->scene_,
                    &simulator_->options_,
                    simulator_->systems_[o].get(),
                    &rollout_->tape_->objects[o],
                    {}};
    for (const StateDerivative& d : derivatives) {
      if (d.object == static_cast<int>(o)) input.derivatives.push_back(&d);
    }
    std::stable_sort(input.derivatives.begin(), input.derivatives.end(),
                     [](const auto* a, const auto* b) { return a->frame < b->frame; });
    ok_ &= method == JacobianMethod::kTangent ? AddTangentJacobian(input, jacobian)
                                              : AddAdjointJacobian(input, jacobian);
  }
}

JacobianMethod Sensitivity::CheaperMethod(
    const std::vector<StateDerivative>& derivatives) const {
  double tangent = 0.0, adjoint = 0.0;
  std::vector<int> last_frame(simulator_->systems_.size(), 0);
  for (const StateDerivative& d : derivatives) {
    last_frame[d.object] = std::max(last_frame[d.object], d.frame);
    adjoint += static_cast<double>(d.frame) *
               std::max(d.d_position.rows(), d.d_velocity.rows());
  }
  for (size_t o = 0; o < simulator_->systems_.size(); ++o) {
    if (!simulator_->systems_[o]) continue;
    tangent += static_cast<double>(last_frame[o]) *
               simulator_->systems_[o]->columns().used().size();
  }
  return tangent <= adjoint ? JacobianMethod::kTangent : JacobianMethod::kAdjoint;
}

}  // namespace dpe
