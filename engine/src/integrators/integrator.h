// One integration step and its derivatives. Each method is one file, with its step, its
// adjoint step and its tangent step side by side.
//
// All methods share the form r = M (v1 - v0) - h phi = 0 and differ in where the force
// expansion phi is taken (force_term.h) and in how x1 follows. Differentiated:
//   A dv1 = Rx dx0 + Rv dv0 + B dp,     dx1 = dx0 + h dv1   (h dv0: explicit Euler)
// with A = dr/dv1 and B = -dr/dp. The adjoint of that, for given gx = dL/dx1, gv =
// dL/dv1 and mu = gv + h gx (gv: explicit Euler), is
//   A^T lambda = mu,  dL/dx0 = gx + Rx^T lambda,  dL/dv0 = Rv^T lambda (+ h gx),
//   dL/dp += B^T lambda.
#ifndef DPE_ENGINE_INTEGRATORS_INTEGRATOR_H_
#define DPE_ENGINE_INTEGRATORS_INTEGRATOR_H_

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "dpe/engine/simulator.h"
#include "object_system.h"

namespace dpe {

// The states around one step: 3N arrays; v0 and v1 hold the prescribed velocity over
// the step at fixed vertices, x1 their prescribed position.
struct StepStates {
  double h = 0.0;
  const double* x0 = nullptr;
  const double* v0 = nullptr;
  const double* x1 = nullptr;
  const double* v1 = nullptr;
};

struct StepOutcome {
  RolloutStatus::Code code = RolloutStatus::Code::kOk;
  std::string reason;
  bool ok() const { return code == RolloutStatus::Code::kOk; }
};

// The derivative of one step, see the head of this file. A is in the system's solver.
struct StepLinearization {
  bool a_is_mass = false;  // A = M (explicit methods): the solver is not used
  bool position_uses_new_velocity = true;
  std::vector<double> rx, rv;           // values in the system's pattern
  std::vector<ParameterEntry> entries;  // B, columns by local_columns()
};

// In: the adjoint of the state after the step. Out: of the state before it; gp (local
// columns) is added to. 3N arrays; entries of fixed vertices carry no meaning.
struct StepAdjoint {
  double* gx = nullptr;
  double* gv = nullptr;
  double* gp = nullptr;
};

class Integrator {
 public:
  explicit Integrator(const SimulatorOptions& options) : options_(options) {}
  virtual ~Integrator() = default;

  // Computes v1 and x1 of the free vertices from states.x0, v0 (x1 and v1 are written
  // through the given pointers; their fixed entries are set already).
  virtual StepOutcome Step(ObjectSystem* system, const StepStates& states, double* x1,
                           double* v1) = 0;

  // False if the step's linear system cannot be solved.
  virtual bool AdjointStep(ObjectSystem* system, const StepStates& states,
                           const StepAdjoint& adjoint) = 0;

  virtual void TangentStep(ObjectSystem* system, const StepStates& states,
                           StepLinearization* out) = 0;

  // Where phi is taken. Arrays it points to stay valid until the next call.
  virtual ForceState ExpansionPoint(const ObjectSystem& system,
                                    const StepStates& states) = 0;

 protected:
  // v1 - v0, into `delta_`; zero at fixed vertices.
  const double* VelocityChange(const ObjectSystem& system, const StepStates& states);
  // The solver's matrix := M - h D - h^2 K at `point`.
  void AssembleStepMatrix(ObjectSystem* system, const ForceState& point, double h);
  // lambda_ := A^{-T} (gv + h gx), scattered to 3N; the matrix must be assembled.
  bool SolveAdjoint(ObjectSystem* system, double h, const StepAdjoint& adjoint);
  // lambda_ := M^{-1} mu, mu = gv + h gx; `h` may be 0.
  void SolveAdjointMass(const ObjectSystem& system, double h,
                        const StepAdjoint& adjoint);
  // gp += lambda^T B.
  void AddParameterAdjoint(const ObjectSystem& system, const StepStates& states,
                           const ForceState& point, double* gp);
  // out->entries := B.
  void ListParameterEntries(const ObjectSystem& system, const StepStates& states,
                            const ForceState& point, StepLinearization* out);
  // Zeroes rx and rv.
  static void ClearLinearization(const ObjectSystem& system, StepLinearization* out);

  SimulatorOptions options_;
  std::vector<double> lambda_;  // 3N

 private:
  std::vector<double> delta_, free_;
};

std::unique_ptr<Integrator> MakeIntegrator(IntegrationMethod method,
                                           const SimulatorOptions& options);

}  // namespace dpe

#endif  // DPE_ENGINE_INTEGRATORS_INTEGRATOR_H_
