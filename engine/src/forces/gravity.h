// Gravity and mass damping of a free vertex: F = m g - alpha m v (Rayleigh damping
// proportional to the current mass). Both are linear, so phi = m g - alpha m (v + dv),
// and the only derivative besides those of the parameters is dphi/dv = df/dv =
// -alpha m I: diagonal, so that this is a term of its own and not a kernel.
#ifndef DPE_ENGINE_FORCES_GRAVITY_H_
#define DPE_ENGINE_FORCES_GRAVITY_H_

#include <utility>
#include <vector>

#include "dpe/engine/scene.h"
#include "forces/force_term.h"

namespace dpe {

class GravityTerm final : public ForceTerm {
 public:
  // Takes the free vertices of `object`.
  GravityTerm(const ClothObject& object, const Eigen::Vector3d& gravity,
              const ObjectParameters* parameters);

  int num_elements() const { return static_cast<int>(vertices_.size()); }

  void AppendCouplings(std::vector<std::pair<int, int>>* /*pairs*/) const override {}
  void BindPattern(const BlockPattern& pattern,
                   const std::vector<int>& node_of_vertex) override;
  void AddForce(const ForceState& state, double* force) const override;
  void AddJacobian(const ForceState& state, double cx, double cv, VelocityPart part,
                   double* values) const override;
  void AddAdjoint(const ForceState& state, const double* lambda, double c,
                  VelocityPart part, double* gx, double* gv,
                  ParameterSink* sink) const override;
  void VisitParameters(const ForceState& state, ParameterSink* sink) const override;

 private:
  // Component k of v + dv.
  static double Velocity(const ForceState& state, int k) {
    return state.dv != nullptr ? state.v[k] + state.dv[k] : state.v[k];
  }
  // The factor by which m enters `part` of dphi/dv.
  double Rate(VelocityPart part) const {
    return -parameters_->damping * PlainWeight(part);
  }

  std::vector<int> vertices_;
  std::vector<BlockSlot> slots_;  // diagonal blocks
  Eigen::Vector3d gravity_;       // m/s^2
  const ObjectParameters* parameters_;
};

}  // namespace dpe

#endif  // DPE_ENGINE_FORCES_GRAVITY_H_
