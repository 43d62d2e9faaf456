// One integration step and its derivatives. Each method is one file, with its step, its
// adjoint step and its tangent step side by side.
//
// A step consists of one or two stages; each solves M (v - v_in) - c phi = 0 for its
// velocity v, with the force expansion phi (force_term.h) at a place that the method
// chooses, and moves the positions. Differentiated, a stage is
//   A dv = Rx dx_in + Rv dv_in + B dp,     dx = dx_in + p dv_in + c dv,
// with A = dr/dv and B = -dr/dp. Its input is a combination of the stage before (the
// state before the step, for the first) and of the state before the step:
//   (dx_in, dv_in) = w (dx, dv)_before + w0 (dx, dv)_0.
// The adjoint of a stage, for given gx = dL/dx, gv = dL/dv and mu = gv + c gx, is
//   A^T lambda = mu,  gx_in = gx + Rx^T lambda,  gv_in = Rv^T lambda + p gx,
//   dL/dp += B^T lambda.
#ifndef DPE_ENGINE_INTEGRATORS_INTEGRATOR_H_
#define DPE_ENGINE_INTEGRATORS_INTEGRATOR_H_

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "dpe/engine/simulator.h"
#include "object_system.h"

namespace dpe {

// The states around one step: 3N arrays; v0, v1 and vs hold the prescribed velocity
// over the step at fixed vertices, x1 and xs their prescribed position.
struct StepStates {
  double h = 0.0;
  const double* x0 = nullptr;
  const double* v0 = nullptr;
  const double* x1 = nullptr;
  const double* v1 = nullptr;
  const double* xs = nullptr;  // after the first of two stages; else null
  const double* vs = nullptr;
  // If not null, what the next call will read and is fetched meanwhile.
  Prefetch* meanwhile = nullptr;
};

// Where a step writes its result; fixed entries are set by the caller, those of the
// stage by the method.
struct StepResult {
  double* x1 = nullptr;
  double* v1 = nullptr;
  double* xs = nullptr;
  double* vs = nullptr;
};

struct StepOutcome {
  RolloutStatus::Code code = RolloutStatus::Code::kOk;
  std::string reason;
  bool ok() const { return code == RolloutStatus::Code::kOk; }
};

// The derivative of one stage, see the head of this file. A is in the solver's values.
struct StageLinearization {
  bool a_is_mass = false;               // A = M (explicit methods): no solver needed
  double p = 0.0;                       // s
  double c = 0.0;                       // s
  double weight = 1.0;                  // w
  double start_weight = 0.0;            // w0
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

  virtual int num_stages() const { return 1; }
  // True if the method solves linear systems.
  virtual bool UsesSolver() const { return true; }
  // True if a step leaves the factorisation of the very matrix that its adjoint solves
  // with. Newton's method leaves that of its first iterate, with which the adjoint
  // would have to iterate: a new one is as cheap, and exact.
  virtual bool LeavesAdjointFactor() const { return false; }

  // What to say of a rollout that left the range of finite numbers; may be empty.
  virtual std::string DivergenceReason() const { return {}; }

  // Computes the free entries of the result from states.x0 and v0 (states.x1 ... point
  // to the result as well).
  virtual StepOutcome Step(ObjectSystem* system, StepSolver* solver,
                           const StepStates& states, const StepResult& result) = 0;

  // Forgets what it remembers of earlier steps as a first guess for an iterative
  // solver, so that the steps that follow are a function of the state alone.
  virtual void ForgetSteps() {}

  // @param solver  as Step left it, then its factorisation is used; or not factorised
  // @return false if the step's linear system cannot be solved
  virtual bool AdjointStep(ObjectSystem* system, StepSolver* solver,
                           const StepStates& states, const StepAdjoint& adjoint) = 0;

  // Of an adjoint step that returned false: whether what it was to solve for is finite.
  bool FailedWithFiniteRightSide() const {
    return std::all_of(lambda_.begin(), lambda_.end(),
                       [](double value) { return std::isfinite(value); });
  }

  // Linearises stage `stage`; assembles A into solver's values.
  virtual void TangentStage(int stage, ObjectSystem* system, StepSolver* solver,
                            const StepStates& states, StageLinearization* out) = 0;

  // The residual M (v1 - v0) - h phi that is linear in the parameters for given states,
  // and where its phi is taken. Arrays it points to stay valid until the next call.
  virtual ForceState ExpansionPoint(const ObjectSystem& system,
                                    const StepStates& states) = 0;

 protected:
  // Makes the solver ready for the matrix in its values: with the factorisation of a
  // nearby matrix if it has one, else with a new one.
  static bool PrepareSolver(const ObjectSystem& system, StepSolver* solver) {
    return solver->factorized() ? solver->KeepFactorization()
                                : solver->Factorize(system.IsSymmetric());
  }
  // b - a, into a buffer that the next call overwrites; zero at fixed vertices.
  const double* Difference(const ObjectSystem& system, const double* a,
                           const double* b);
  // lambda_ := A^{-T} mu for the mu (3N) that lambda_ holds; the solver is ready.
  bool SolveAdjoint(const ObjectSystem& system, StepSolver* solver);
  // The same by a factorisation that the step itself has left, without its matrix,
  // where that is as exact. False if not; lambda_ still holds mu then.
  bool SolveAdjointByKept(const ObjectSystem& system, StepSolver* solver);
  // lambda_ := gv + c gx at free vertices, 0 elsewhere.
  void SetMu(const ObjectSystem& system, double c, const StepAdjoint& adjoint);
  // Appends c dphi/dp - (dM/dp) dv to out->entries.
  static void ListParameterEntries(const ObjectSystem& system, const ForceState& point,
                                   double c, const double* dv, StageLinearization* out);
  // Zeroes rx, rv and the entries.
  static void ClearLinearization(const ObjectSystem& system, StageLinearization* out);

  SimulatorOptions options_;
  std::vector<double> lambda_;  // 3N
  std::vector<double> free_;    // the unknowns of a linear system

 private:
  std::vector<double> difference_, last_adjoint_;
};

std::unique_ptr<Integrator> MakeIntegrator(IntegrationMethod method,
                                           const SimulatorOptions& options);

}  // namespace dpe

#endif  // DPE_ENGINE_INTEGRATORS_INTEGRATOR_H_
