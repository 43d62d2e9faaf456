// A force law over the vertices of one object, with everything that rollouts and their
// derivative passes ask of it.
//
// Every pass works on the directional expansion of the force f(x, v; p),
//   phi(x, v; p) = f + df/dx dx + df/dv dv,
// for a given direction (dx, dv). With no direction phi is the force itself; with
// (dx, dv) = (h v1, v1 - v0) it is the right hand side of the linearly implicit step,
// whose derivative needs the second derivatives of f.
#ifndef DPE_ENGINE_FORCES_FORCE_TERM_H_
#define DPE_ENGINE_FORCES_FORCE_TERM_H_

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "forces/parameter_sink.h"
#include "linear/block_pattern.h"
#include "linear/prefetch.h"

namespace dpe {

// The current values of an object's physical parameters; force terms read them at every
// evaluation, so that changing a value needs no set-up.
struct ObjectParameters {
  Eigen::VectorXd mass;       // kg, per vertex
  Eigen::VectorXd stiffness;  // N/m, per spring
  double damping = 0.0;       // alpha (1/s), and beta = damping / 2 (s)
  double drag_coefficient = 0.0;
  Eigen::Vector3d wind = Eigen::Vector3d::Zero();  // m/s
};

// States are arrays of 3N doubles, xyz interleaved, fixed vertices included.
struct ForceState {
  const double* x = nullptr;   // m
  const double* v = nullptr;   // m/s
  const double* dx = nullptr;  // direction; null: both dx and dv are zero
  const double* dv = nullptr;
  // If not null, what will be needed next and is fetched meanwhile.
  Prefetch* meanwhile = nullptr;
};

// Which part of dphi/dv is meant.
enum class VelocityPart {
  kWhole,      // dphi/dv
  kMinusPlain  // dphi/dv - df/dv: the part that second derivatives contribute
};

// The weight that df/dv has in a part of dphi/dv.
inline double PlainWeight(VelocityPart part) {
  return part == VelocityPart::kWhole ? 1.0 : 0.0;
}

class ForceTerm {
 public:
  virtual ~ForceTerm() = default;

  // Appends the pairs of vertices that an element of this term couples.
  virtual void AppendCouplings(std::vector<std::pair<int, int>>* pairs) const = 0;

  // Looks up, once, where its blocks live. `node_of_vertex` is -1 for fixed vertices.
  virtual void BindPattern(const BlockPattern& pattern,
                           const std::vector<int>& node_of_vertex) = 0;

  // force += phi (3N).
  virtual void AddForce(const ForceState& state, double* force) const = 0;

  // values += cx dphi/dx + cv dphi/dv, in the bound pattern.
  virtual void AddJacobian(const ForceState& state, double cx, double cv,
                           VelocityPart part, double* values) const = 0;

  // gx += c (dphi/dx)^T lambda and gv += c (dphi/dv)^T lambda; `lambda` (3N) must be
  // zero at fixed vertices.
  //
  // @param gv    null if it is not wanted
  // @param sink  if not null, what VisitParameters does as well; its adjoint is lambda
  //              and its scale is c. Where elements are looked at anyway that costs
  //              little
  virtual void AddAdjoint(const ForceState& state, const double* lambda, double c,
                          VelocityPart part, double* gx, double* gv,
                          ParameterSink* sink) const = 0;

  // Reports dphi/dp for each parameter this term owns.
  virtual void VisitParameters(const ForceState& state, ParameterSink* sink) const = 0;

  // Why the force is not defined at positions x (3N), naming the element; empty if it
  // is. Asked after a failure only.
  virtual std::string UndefinedReason(const double* /*x*/) const { return {}; }

  // True if df/dx and df/dv are symmetric matrices at the current parameters.
  virtual bool IsSymmetric() const { return true; }
};

}  // namespace dpe

#endif  // DPE_ENGINE_FORCES_FORCE_TERM_H_
