#include "forces/gravity.h"

namespace dpe {

GravityTerm::GravityTerm(const ClothObject& object, const Eigen::Vector3d& gravity,
                         const ObjectParameters* parameters)
    : gravity_(gravity), parameters_(parameters) {
  for (int i = 0; i < object.num_vertices(); ++i) {
    if (!object.is_fixed[i]) vertices_.push_back(i);
  }
}

void GravityTerm::BindPattern(const BlockPattern& pattern,
                              const std::vector<int>& node_of_vertex) {
  slots_.clear();
  for (int i : vertices_) {
    slots_.push_back(pattern.Find(node_of_vertex[i], node_of_vertex[i]));
  }
}

void GravityTerm::AddForce(const ForceState& state, double* force) const {
  const double alpha = parameters_->damping;
  for (int i : vertices_) {
    const double m = parameters_->mass[i];
    for (int c = 0; c < 3; ++c) {
      const int k = 3 * i + c;
      force[k] += m * gravity_[c];
      if (alpha != 0.0) force[k] -= m * alpha * Velocity(state, k);
    }
  }
}

void GravityTerm::AddJacobian(const ForceState& /*state*/, double /*cx*/, double cv,
                              VelocityPart part, double* values) const {
  const double rate = cv * Rate(part);
  if (rate == 0.0) return;
  for (size_t e = 0; e < vertices_.size(); ++e) {
    const BlockSlot& slot = slots_[e];
    const double entry = rate * parameters_->mass[vertices_[e]];
    for (int c = 0; c < 3; ++c) values[slot.offset + c * slot.stride + c] += entry;
  }
}

void GravityTerm::AddAdjoint(const ForceState& state, const double* lambda, double c,
                             VelocityPart part, double* /*gx*/, double* gv,
                             ParameterSink* sink) const {
  if (sink != nullptr) VisitParameters(state, sink);
  const double rate = c * Rate(part);
  if (rate == 0.0 || gv == nullptr) return;
  for (int i : vertices_) {
    const double factor = rate * parameters_->mass[i];
    for (int k = 3 * i; k < 3 * i + 3; ++k) gv[k] += factor * lambda[k];
  }
}

void GravityTerm::VisitParameters(const ForceState& state, ParameterSink* sink) const {
  const bool wants_mass = sink->Wants(ParameterKind::kMass);
  const bool wants_damping = sink->Wants(ParameterKind::kDamping);
  if (!wants_mass && !wants_damping) return;
  const double one = 1.0;
  for (int i : vertices_) {
    const Eigen::Vector3d v(Velocity(state, 3 * i), Velocity(state, 3 * i + 1),
                            Velocity(state, 3 * i + 2));
    if (wants_mass) {
      sink->Add(ParameterKind::kMass, i, gravity_ - parameters_->damping * v, &i, &one,
                1);
    }
    if (wants_damping) {
      sink->Add(ParameterKind::kDamping, 0, -parameters_->mass[i] * v, &i, &one, 1);
    }
  }
}

}  // namespace dpe
