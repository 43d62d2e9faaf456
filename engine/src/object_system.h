// The system of equations of one object: which vertices are unknowns, which forces act,
// the sparsity of its step matrix, and the evaluations that integrators are built from.
// Nothing couples objects, so each is solved on its own.
//
// All state arrays hold 3N doubles for all N vertices; only linear systems are reduced
// to the free ones ("nodes").
#ifndef DPE_ENGINE_OBJECT_SYSTEM_H_
#define DPE_ENGINE_OBJECT_SYSTEM_H_

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "dpe/engine/parameters.h"
#include "dpe/engine/scene.h"
#include "dpe/engine/timings.h"
#include "forces/collider.h"
#include "forces/force_term.h"
#include "forces/parameter_sink.h"
#include "linear/block_pattern.h"
#include "linear/step_solver.h"

namespace dpe {

// A fixed vertex on its way during the frame at hand, in place of its path.
struct DrivenVertex {
  int vertex = -1;
  Eigen::Vector3d from, to;  // m, at the frame's beginning and end
};

class ObjectSystem {
 public:
  // @param timings  if not null, receives where the time went
  ObjectSystem(const Scene& scene, int object, const ParameterLayout& layout,
               Timings* timings = nullptr);
  ObjectSystem(const ObjectSystem&) = delete;
  ObjectSystem& operator=(const ObjectSystem&) = delete;

  int num_vertices() const { return static_cast<int>(node_of_vertex_.size()); }
  int num_coordinates() const { return 3 * num_vertices(); }
  // Free vertices in the order of their unknowns.
  const std::vector<int>& free_vertices() const { return free_vertices_; }
  const std::vector<int>& node_of_vertex() const { return node_of_vertex_; }
  const BlockPattern& pattern() const { return pattern_; }
  // Where the diagonal block of each node is.
  const std::vector<BlockSlot>& diagonal() const { return diagonal_; }
  StepSolver* solver() { return solver_.get(); }
  // Bytes of a factorisation that a rollout keeps, at the current parameters.
  size_t factor_bytes() const { return solver_context_->kept_bytes(IsSymmetric()); }
  std::vector<std::unique_ptr<KeptFactor>> MakeKeptFactors(int count) const;
  // Whether keeping factorisations saves more than the assembly of their matrices.
  bool KeepingFactorsPays() const { return !solver_context_->iterative; }
  // Numbers in the panels of one triangular factor.
  size_t factor_values() const {
    return solver_context_->direct->structure()->num_lower_values();
  }

  const ObjectParameters& parameters() const { return parameters_; }
  // Columns of this object's parameters in the layout, and the same renumbered from 0.
  const ParameterColumns& columns() const { return columns_; }
  const ParameterColumns& local_columns() const { return local_columns_; }

  // Takes this object's values out of `scene` (which holds the current parameters).
  void SetParameters(const Scene& scene);
  // Takes the scene's colliders in place of those it has. Allocates nothing if there
  // are as many as before.
  void SetColliders(const Scene& scene);
  // Fixed vertices that do not follow the scene's paths; null: none. Not copied.
  void SetDrivenVertices(const std::vector<DrivenVertex>* driven) { driven_ = driven; }
  const Eigen::VectorXd& initial_positions() const { return initial_positions_; }
  const Eigen::VectorXd& initial_velocities() const { return initial_velocities_; }

  // Positions of the fixed vertices after `step` steps of the rollout, written into x.
  void SetPrescribedPositions(int step, double* x) const;
  // v at fixed vertices := (x1 - x0) / h, the prescribed velocity over a step.
  void SetPrescribedVelocities(double h, const double* x0, const double* x1,
                               double* v) const;

  // force := phi (see force_term.h); entries of fixed vertices are set to 0.
  void Force(const ForceState& state, double* force) const;
  // values += cx dphi/dx + cv dphi/dv.
  void AddJacobian(const ForceState& state, double cx, double cv, VelocityPart part,
                   double* values) const;
  // values += M.
  void AddMass(double* values) const;
  // values := M - c D - c^2 K at (x, v), the matrix of an implicit step.
  void AssembleStepMatrix(const double* x, const double* v, double c,
                          std::vector<double>* values) const;
  // gx += c (dphi/dx)^T lambda, gv += c (dphi/dv)^T lambda.
  void AddAdjoint(const ForceState& state, const double* lambda, double c,
                  VelocityPart part, double* gx, double* gv) const;
  // The same, and the adjoint of the parameters as by VisitStepParameters, in one pass
  // over the elements: gp (local columns) += lambda^T (c dphi/dp - (dM/dp) dv).
  //
  // @param gv  null if it is not wanted
  void AddStepAdjoint(const ForceState& state, const double* lambda, double c,
                      VelocityPart part, const double* dv, double* gx, double* gv,
                      double* gp) const;
  // Reports -dr/dp of the step residual r = M dv - h phi: h dphi/dp - (dM/dp) dv.
  void VisitStepParameters(const ForceState& state, double h, const double* dv,
                           ParameterSink* sink) const;
  // Why some force is not defined at x, naming the element; empty if all are.
  std::string UndefinedReason(const double* x) const;
  // How large the terms are of which contact forces at a free vertex at x (m) are the
  // differences, N.
  double ContactTerms(const double* x) const;
  // True if df/dx and df/dv are symmetric at the current parameters.
  bool IsSymmetric() const;

  // Between 3N arrays and the unknowns.
  void GatherFree(const double* full, double* free) const;
  void ScatterFree(const double* free, double* full) const;

 private:
  void AddForceTerms(const Scene& scene, const ClothObject& object);
  void AddColliders(const Scene& scene, const ClothObject& object);
  void BuildPattern();
  void VisitMass(const double* dv, ParameterSink* sink) const;

  int object_;
  Timings* timings_;
  int steps_per_frame_;
  std::vector<int> free_vertices_, fixed_vertices_, node_of_vertex_;
  ObjectParameters parameters_;
  Eigen::VectorXd initial_positions_, initial_velocities_;
  std::vector<PrescribedPath> paths_;
  const std::vector<DrivenVertex>* driven_ = nullptr;
  std::vector<std::unique_ptr<ForceTerm>> terms_;
  std::vector<ColliderTerm*> colliders_;  // the last of terms_
  ParameterColumns columns_, local_columns_;
  BlockPattern pattern_;
  std::vector<BlockSlot> diagonal_;
  std::shared_ptr<StepSolverContext> solver_context_;
  std::unique_ptr<StepSolver> solver_;
};

}  // namespace dpe

#endif  // DPE_ENGINE_OBJECT_SYSTEM_H_
