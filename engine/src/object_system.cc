#include "object_system.h"

#include <algorithm>
#include <utility>

#include "forces/drag.h"
#include "forces/gravity.h"
#include "forces/spring.h"
#include "linear/ordering.h"

namespace dpe {

ObjectSystem::ObjectSystem(const Scene& scene, int object,
                           const ParameterLayout& layout, Timings* timings)
    : object_(object),
      timings_(timings),
      steps_per_frame_(scene.steps_per_frame),
      paths_(scene.objects[object].prescribed_paths),
      columns_(layout, object),
      local_columns_(columns_.Compressed()) {
  const ClothObject& cloth = scene.objects[object];
  node_of_vertex_.assign(cloth.num_vertices(), -1);
  for (int i = 0; i < cloth.num_vertices(); ++i) {
    if (cloth.is_fixed[i]) {
      fixed_vertices_.push_back(i);
    } else {
      free_vertices_.push_back(i);
    }
  }
  SetParameters(scene);
  AddForceTerms(scene, cloth);

  BuildPattern();
  for (const auto& term : terms_) term->BindPattern(pattern_, node_of_vertex_);
  for (int i = 0; i < pattern_.num_nodes(); ++i)
    diagonal_.push_back(pattern_.Find(i, i));
  solver_context_ = std::make_shared<StepSolverContext>(pattern_);
  solver_context_->timings = timings;
  solver_context_->tolerance = scene.tolerance;
  solver_context_->iterative =
      scene.solver == "cg" ||
      (scene.solver == "auto" && PrefersIterativeSolver(pattern_.num_rows()));
  solver_ = std::make_unique<StepSolver>(solver_context_);
}

// Numbers the unknowns in a fill-reducing order and builds the sparsity of their
// system.
void ObjectSystem::BuildPattern() {
  std::vector<std::pair<int, int>> pairs;
  for (const auto& term : terms_) term->AppendCouplings(&pairs);
  const int num_nodes = static_cast<int>(free_vertices_.size());
  const auto number_nodes = [&] {
    for (int k = 0; k < num_nodes; ++k) node_of_vertex_[free_vertices_[k]] = k;
    std::vector<std::pair<int, int>> nodes = pairs;
    for (auto& [a, b] : nodes) {
      a = node_of_vertex_[a];
      b = node_of_vertex_[b];
    }
    return nodes;
  };
  std::vector<int> ordered;
  for (int k : FillReducingOrder(num_nodes, number_nodes())) {
    ordered.push_back(free_vertices_[k]);
  }
  free_vertices_ = ordered;
  pattern_ = BlockPattern(num_nodes, number_nodes());
}

// The registration of force laws: a term exists only where the scene asks for it.
void ObjectSystem::AddForceTerms(const Scene& scene, const ClothObject& cloth) {
  const auto add = [this](auto term) {
    if (term.num_elements() == 0) return;
    terms_.push_back(std::make_unique<decltype(term)>(std::move(term)));
  };
  add(GravityTerm(cloth, scene.gravity, &parameters_));
  add(SpringTerm(SpringLaw(cloth, &parameters_)));
  if (cloth.drag_coefficient != 0.0 || cloth.estimate_drag) {
    add(DragTerm(DragLaw(cloth, scene.aerodynamics, &parameters_)));
  }
  AddColliders(scene, cloth);
}

void ObjectSystem::AddColliders(const Scene& scene, const ClothObject& cloth) {
  if (free_vertices_.empty()) return;
  for (const Collider& collider : scene.colliders) {
    if (collider.stiffness == 0.0) continue;
    auto term = std::make_unique<ColliderTerm>(ColliderKernel(cloth, collider));
    colliders_.push_back(term.get());
    terms_.push_back(std::move(term));
  }
}

void ObjectSystem::SetColliders(const Scene& scene) {
  const auto acts = [](const Collider& c) { return c.stiffness != 0.0; };
  if (colliders_.size() ==
      std::count_if(scene.colliders.begin(), scene.colliders.end(), acts)) {
    size_t next = 0;
    for (const Collider& collider : scene.colliders) {
      if (acts(collider)) colliders_[next++]->mutable_kernel()->SetCollider(collider);
    }
    return;
  }
  terms_.resize(terms_.size() - colliders_.size());
  colliders_.clear();
  // They couple no vertices, so the pattern is as it was.
  AddColliders(scene, scene.objects[object_]);
  for (ColliderTerm* term : colliders_) term->BindPattern(pattern_, node_of_vertex_);
}

void ObjectSystem::SetParameters(const Scene& scene) {
  const ClothObject& cloth = scene.objects[object_];
  parameters_.mass = cloth.mass;
  parameters_.stiffness = cloth.stiffness;
  parameters_.damping = cloth.damping;
  parameters_.drag_coefficient = cloth.drag_coefficient;
  parameters_.wind = scene.wind;
  initial_positions_ = cloth.positions;
  initial_velocities_ = cloth.velocities;
  SetPrescribedPositions(0, initial_positions_.data());
  for (int i : fixed_vertices_) initial_velocities_.segment<3>(3 * i).setZero();
}

void ObjectSystem::SetPrescribedPositions(int step, double* x) const {
  for (const PrescribedPath& path : paths_) {
    const int last = static_cast<int>(path.positions.cols()) - 1;
    const int frame = std::min(step / steps_per_frame_, last);
    const double fraction =
        frame == last ? 0.0
                      : static_cast<double>(step % steps_per_frame_) / steps_per_frame_;
    Eigen::Map<Eigen::Vector3d> point(x + 3 * path.vertex);
    point = path.positions.col(frame);
    if (fraction > 0.0) {
      point += fraction * (path.positions.col(frame + 1) - path.positions.col(frame));
    }
  }
  if (driven_ == nullptr || step == 0) return;
  const int step_in_frame = (step - 1) % steps_per_frame_ + 1;  // the last is the end
  const double left = 1.0 - static_cast<double>(step_in_frame) / steps_per_frame_;
  for (const DrivenVertex& driven : *driven_) {
    Eigen::Map<Eigen::Vector3d>(x + 3 * driven.vertex) =
        driven.to + left * (driven.from - driven.to);
  }
}

void ObjectSystem::SetPrescribedVelocities(double h, const double* x0, const double* x1,
                                           double* v) const {
  for (int i : fixed_vertices_) {
    for (int c = 3 * i; c < 3 * i + 3; ++c) v[c] = (x1[c] - x0[c]) / h;
  }
}

void ObjectSystem::Force(const ForceState& state, double* force) const {
  const ScopedTimer timer(timings_, TimedPart::kForces);
  std::fill(force, force + num_coordinates(), 0.0);
  for (const auto& term : terms_) term->AddForce(state, force);
  for (int i : fixed_vertices_) std::fill(force + 3 * i, force + 3 * i + 3, 0.0);
}

void ObjectSystem::AddJacobian(const ForceState& state, double cx, double cv,
                               VelocityPart part, double* values) const {
  const ScopedTimer timer(timings_, TimedPart::kAssembly);
  for (const auto& term : terms_) term->AddJacobian(state, cx, cv, part, values);
}

void ObjectSystem::AddMass(double* values) const {
  for (int node = 0; node < pattern_.num_nodes(); ++node) {
    const double m = parameters_.mass[free_vertices_[node]];
    const BlockSlot& slot = diagonal_[node];
    for (int c = 0; c < 3; ++c) values[slot.offset + c * slot.stride + c] += m;
  }
}

void ObjectSystem::AssembleStepMatrix(const double* x, const double* v, double c,
                                      std::vector<double>* values) const {
  values->assign(pattern_.num_nonzeros(), 0.0);
  AddMass(values->data());
  AddJacobian({x, v, nullptr, nullptr}, -c * c, -c, VelocityPart::kWhole,
              values->data());
}

void ObjectSystem::AddAdjoint(const ForceState& state, const double* lambda, double c,
                              VelocityPart part, double* gx, double* gv) const {
  for (const auto& term : terms_) {
    term->AddAdjoint(state, lambda, c, part, gx, gv, nullptr);
  }
}

void ObjectSystem::AddStepAdjoint(const ForceState& state, const double* lambda,
                                  double c, VelocityPart part, const double* dv,
                                  double* gx, double* gv, double* gp) const {
  ParameterSink sink(local_columns_, c, lambda, gp);
  ParameterSink* const wanted = local_columns_.used().empty() ? nullptr : &sink;
  for (const auto& term : terms_) {
    term->AddAdjoint(state, lambda, c, part, gx, gv, wanted);
  }
  if (wanted != nullptr) VisitMass(dv, wanted);
}

void ObjectSystem::VisitStepParameters(const ForceState& state, double h,
                                       const double* dv, ParameterSink* sink) const {
  sink->set_scale(h);
  for (const auto& term : terms_) term->VisitParameters(state, sink);
  VisitMass(dv, sink);
}

void ObjectSystem::VisitMass(const double* dv, ParameterSink* sink) const {
  if (!sink->Wants(ParameterKind::kMass)) return;
  sink->set_scale(1.0);
  const double weight = 1.0;
  for (int i : free_vertices_) {
    const Eigen::Vector3d d = -Eigen::Map<const Eigen::Vector3d>(dv + 3 * i);
    sink->Add(ParameterKind::kMass, i, d, &i, &weight, 1);
  }
}

std::string ObjectSystem::UndefinedReason(const double* x) const {
  for (const auto& term : terms_) {
    const std::string reason = term->UndefinedReason(x);
    if (!reason.empty()) return reason;
  }
  return {};
}

double ObjectSystem::ContactTerms(const double* x) const {
  double sum = 0.0;
  for (const ColliderTerm* term : colliders_) {
    const ColliderKernel& collider = term->kernel();
    sum += collider.stiffness() *
           collider.RoundedLength(Eigen::Map<const Eigen::Vector3d>(x));
  }
  return sum;
}

bool ObjectSystem::IsSymmetric() const {
  return std::all_of(terms_.begin(), terms_.end(),
                     [](const auto& term) { return term->IsSymmetric(); });
}

std::vector<std::unique_ptr<KeptFactor>> ObjectSystem::MakeKeptFactors(
    int count) const {
  std::vector<std::unique_ptr<KeptFactor>> factors;
  if (count == 0) return factors;
  for (const SupernodalPanels& panels : SupernodalPanels::MakeSeveral(
           *solver_context_->direct->structure(), IsSymmetric(), count)) {
    factors.push_back(std::make_unique<KeptFactor>());
    factors.back()->panels = panels;
  }
  return factors;
}

void ObjectSystem::GatherFree(const double* full, double* free) const {
  for (int i : free_vertices_) {
    for (int c = 0; c < 3; ++c) *free++ = full[3 * i + c];
  }
}

void ObjectSystem::ScatterFree(const double* free, double* full) const {
  for (int i : free_vertices_) {
    for (int c = 0; c < 3; ++c) full[3 * i + c] = *free++;
  }
}

}  // namespace dpe
