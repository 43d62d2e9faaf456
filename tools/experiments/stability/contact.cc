#include "experiments/stability/contact.h"

#include <algorithm>
#include <map>

namespace dpe::experiments {
namespace {

// The scene without any force but that of its first collider.
Scene OnlyCollider(const Scene& scene) {
  const ClothObject& cloth = scene.objects[0];
  ClothObject points;
  points.positions = cloth.positions;
  points.velocities = cloth.velocities;
  points.is_fixed = cloth.is_fixed;
  points.mass = cloth.mass;
  Scene result;
  result.integration_method = IntegrationMethod::kExplicitEuler;
  result.gravity.setZero();
  result.colliders = {scene.colliders[0]};
  result.objects = {points};
  return result;
}

}  // namespace

ContactProbe::ContactProbe(const Scene& scene) {
  if (scene.colliders.empty()) return;
  simulator_ = std::make_unique<Simulator>(OnlyCollider(scene));
  stiffness_ = scene.colliders[0].stiffness;
}

Eigen::VectorXd ContactProbe::Depths(const Eigen::VectorXd& x) const {
  Eigen::VectorXd depths = Eigen::VectorXd::Zero(x.size() / 3);
  if (!simulator_ || !(stiffness_ > 0.0)) return depths;
  // A step of explicit Euler with v1 = v0 and h = 1 has the residual -f.
  const Eigen::VectorXd at_rest = Eigen::VectorXd::Zero(x.size());
  Eigen::VectorXd residual;
  std::vector<Eigen::Triplet<double>> unused;
  simulator_->StepResidual(0, 1.0, x, at_rest, x, at_rest,
                           Eigen::VectorXd::Zero(simulator_->layout().size()),
                           &residual, &unused);
  for (int i = 0; i < depths.size(); ++i) {
    depths[i] = residual.segment<3>(3 * i).norm() / stiffness_;
  }
  return depths;
}

double ContactProbe::Deepest(const Eigen::MatrixXd& positions) const {
  double deepest = 0.0;
  for (Eigen::Index f = 0; f < positions.cols(); ++f) {
    deepest = std::max(deepest, Depths(positions.col(f)).maxCoeff());
  }
  return deepest;
}

std::vector<ContactState> ContactStates(const Scene& scene,
                                        const Eigen::MatrixXd& positions, int most) {
  const ContactProbe probe(scene);
  std::map<std::vector<bool>, ContactState> by_vertices;
  for (Eigen::Index f = 0; f < positions.cols(); ++f) {
    const Eigen::VectorXd depths = probe.Depths(positions.col(f));
    if (!(depths.maxCoeff() > 0.0)) continue;
    std::vector<bool> touching(depths.size());
    for (Eigen::Index i = 0; i < depths.size(); ++i) touching[i] = depths[i] > 0.0;
    ContactState& state = by_vertices[touching];
    if (state.count++ == 0) state.frame = static_cast<int>(f);
  }
  std::vector<ContactState> states;
  for (const auto& [touching, state] : by_vertices) {
    states.push_back({state.frame, state.count, touching});
  }
  std::sort(states.begin(), states.end(),
            [](const ContactState& a, const ContactState& b) {
              return a.count != b.count ? a.count > b.count : a.frame < b.frame;
            });
  if (static_cast<int>(states.size()) > most) states.resize(most);
  return states;
}

}  // namespace dpe::experiments
