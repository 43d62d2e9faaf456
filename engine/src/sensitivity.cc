#include "dpe/engine/sensitivity.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>

#include "derivatives/gradient_pass.h"
#include "derivatives/jacobian_cost.h"
#include "derivatives/jacobian_pass.h"
#include "dpe/engine/parallel.h"
#include "object_system.h"
#include "rollout_tape.h"

namespace dpe {
namespace {

// Those of one object, sorted by frame.
StateDerivatives DerivativesOf(const std::vector<StateDerivative>& derivatives,
                               int object) {
  StateDerivatives result;
  for (const StateDerivative& d : derivatives) {
    if (d.object == object) result.push_back(&d);
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const auto* a, const auto* b) { return a->frame < b->frame; });
  return result;
}

// Row by row, so that the pages of a large matrix are written first, not read, and by
// all threads: a Jacobian is the largest thing in memory by far.
void SetZero(int num_threads, RowMajorMatrix* matrix) {
  const Eigen::Index num_chunks = std::min<Eigen::Index>(matrix->rows(), 64);
  ParallelFor(num_threads, static_cast<int>(num_chunks), [&](int i) {
    const Eigen::Index begin = matrix->rows() * i / num_chunks;
    const Eigen::Index end = matrix->rows() * (i + 1) / num_chunks;
    matrix->middleRows(begin, end - begin).setZero();
  });
}

// Derivatives of a rollout that is finite grow with every step of an unstable motion,
// and may leave the range of finite numbers where its states do not.
bool IsFinite(int num_threads, const RowMajorMatrix& matrix) {
  const Eigen::Index num_chunks = std::min<Eigen::Index>(matrix.rows(), 64);
  std::atomic<bool> finite{true};
  ParallelFor(num_threads, static_cast<int>(num_chunks), [&](int i) {
    const Eigen::Index begin = matrix.rows() * i / num_chunks;
    const Eigen::Index end = matrix.rows() * (i + 1) / num_chunks;
    if (!matrix.middleRows(begin, end - begin).allFinite()) finite = false;
  });
  return finite;
}

}  // namespace

Sensitivity::Sensitivity(Simulator* simulator, const Rollout* rollout)
    : simulator_(simulator), rollout_(rollout) {
  if (simulator_->current_parameters_ != rollout_->parameters_) {
    simulator_->SetParameters(rollout_->parameters_);
  }
}

ObjectRecord Sensitivity::Record(int object) const {
  return {&simulator_->scene_,
          &simulator_->options_,
          simulator_->systems_[object].get(),
          &rollout_->tape_->objects[object],
          &rollout_->trajectory_.positions[object],
          &rollout_->trajectory_.velocities[object]};
}

void Sensitivity::Note(int object, const PassOutcome& pass) {
  if (pass.ok() || !status_.ok()) return;
  const int steps_per_frame = simulator_->scene_.steps_per_frame;
  status_.pass = RolloutStatus::Pass::kDerivative;
  status_.code = pass.outcome.code;
  status_.reason = pass.outcome.reason;
  status_.object = object;
  status_.frame = pass.step / steps_per_frame + 1;
  status_.step = pass.step % steps_per_frame;
}

void Sensitivity::NoteNotFinite(const std::vector<StateDerivative>& derivatives,
                                const RowMajorMatrix& jacobian) {
  int row = 0;
  while (jacobian.row(row).allFinite()) ++row;
  int column = 0;
  while (std::isfinite(jacobian(row, column))) ++column;
  status_.pass = RolloutStatus::Pass::kDerivative;
  status_.code = RolloutStatus::Code::kNotFinite;
  for (const StateDerivative& d : derivatives) {
    const Eigen::Index num_rows = std::max(d.d_position.rows(), d.d_velocity.rows());
    if (row < d.first_row || row >= d.first_row + num_rows) continue;
    if (d.frame <= status_.frame) continue;
    status_.frame = d.frame;
    status_.object = d.object;
  }
  status_.reason = "residual row " + std::to_string(row);
  for (const ParameterBlock& block : simulator_->layout().blocks()) {
    if (column < block.offset || column >= block.offset + block.size) continue;
    status_.reason += " by " + ParameterKindName(block.kind) + " " +
                      std::to_string(column - block.offset);
  }
}

Eigen::VectorXd Sensitivity::Gradient(const std::vector<Eigen::MatrixXd>& dl_dx,
                                      const std::vector<Eigen::MatrixXd>& dl_dv) {
  const ScopedTimer timer(simulator_->options_.timings, TimedPart::kDerivatives);
  const int num_objects = static_cast<int>(simulator_->systems_.size());
  std::vector<Eigen::VectorXd> parts(num_objects);
  std::vector<PassOutcome> passes(num_objects);
  ParallelFor(simulator_->options_.num_threads, num_objects, [&](int o) {
    const Eigen::MatrixXd none;
    const Eigen::MatrixXd& seed_x =
        o < static_cast<int>(dl_dx.size()) ? dl_dx[o] : none;
    const Eigen::MatrixXd& seed_v =
        o < static_cast<int>(dl_dv.size()) ? dl_dv[o] : none;
    if (!simulator_->systems_[o] || (seed_x.size() == 0 && seed_v.size() == 0)) return;
    passes[o] = ObjectGradient(Record(o), seed_x, seed_v, &parts[o]);
  });
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(simulator_->layout().size());
  for (int o = 0; o < num_objects; ++o) {  // in this order whatever the threads
    Note(o, passes[o]);
    if (parts[o].size() == 0) continue;
    const std::vector<int>& columns = simulator_->systems_[o]->columns().used();
    for (size_t k = 0; k < columns.size(); ++k) gradient[columns[k]] += parts[o][k];
  }
  if (status_.ok() && !gradient.allFinite()) {  // the sum over objects
    status_.pass = RolloutStatus::Pass::kDerivative;
    status_.code = RolloutStatus::Code::kNotFinite;
  }
  return gradient;
}

void Sensitivity::JacobianVectorProduct(const Eigen::VectorXd& dp,
                                        std::vector<Eigen::MatrixXd>* dx,
                                        std::vector<Eigen::MatrixXd>* dv) {
  const ScopedTimer timer(simulator_->options_.timings, TimedPart::kDerivatives);
  const int num_objects = static_cast<int>(simulator_->systems_.size());
  dx->assign(num_objects, {});
  dv->assign(num_objects, {});
  std::vector<PassOutcome> passes(num_objects);
  ParallelFor(simulator_->options_.num_threads, num_objects, [&](int o) {
    if (!simulator_->systems_[o]) return;
    passes[o] = PropagateTangent(Record(o), dp, &(*dx)[o], &(*dv)[o]);
  });
  for (int o = 0; o < num_objects; ++o) Note(o, passes[o]);
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
  jacobian->resize(num_rows, simulator_->layout().size());
  SetZero(simulator_->options_.num_threads, jacobian);
  // One object after the other: several may add to the same rows.
  for (int o = 0; o < static_cast<int>(simulator_->systems_.size()); ++o) {
    if (!simulator_->systems_[o]) continue;
    const StateDerivatives of_object = DerivativesOf(derivatives, o);
    Note(o, method == JacobianMethod::kTangent
                ? AddTangentJacobian(Record(o), of_object, jacobian)
                : AddAdjointJacobian(Record(o), of_object, jacobian));
  }
  if (status_.ok() && !IsFinite(simulator_->options_.num_threads, *jacobian)) {
    NoteNotFinite(derivatives, *jacobian);
  }
}

JacobianCosts Sensitivity::PredictCosts(
    const std::vector<StateDerivative>& derivatives) const {
  JacobianCosts sum;
  for (int o = 0; o < static_cast<int>(simulator_->systems_.size()); ++o) {
    if (!simulator_->systems_[o]) continue;
    const JacobianCosts costs =
        PredictJacobianCosts(Record(o), DerivativesOf(derivatives, o));
    sum.tangent += costs.tangent;
    sum.adjoint += costs.adjoint;
  }
  return sum;
}

JacobianMethod Sensitivity::CheaperMethod(
    const std::vector<StateDerivative>& derivatives) const {
  const JacobianCosts costs = PredictCosts(derivatives);
  return costs.tangent <= costs.adjoint ? JacobianMethod::kTangent
                                        : JacobianMethod::kAdjoint;
}

}  // namespace dpe
