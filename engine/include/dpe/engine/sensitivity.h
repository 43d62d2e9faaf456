// Exact derivatives of a rollout's states with respect to the parameter vector.
//
// One step is r(y1; y0, p) = 0 with y = (x, v). The adjoint (backward pass) solves
//   (dr/dy1)^T mu = dL/dy1,  dL/dy0 -= (dr/dy0)^T mu,  dL/dp -= (dr/dp)^T mu,
// the tangent (forward sensitivity)
//   (dr/dy1) dy1 = -(dr/dy0) dy0 - (dr/dp) dp.
// Both differentiate the discrete step that was taken, so they agree with central
// differences of the rollout and with each other.
#ifndef DPE_ENGINE_SENSITIVITY_H_
#define DPE_ENGINE_SENSITIVITY_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "dpe/engine/export.h"
#include "dpe/engine/simulator.h"

namespace dpe {

enum class JacobianMethod { kAuto, kTangent, kAdjoint };

using RowMajorMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

// The derivative of some residual rows with respect to one object's state at one frame.
struct StateDerivative {
  int frame = 0;
  int object = 0;
  int first_row = 0;      // rows first_row ... first_row + d_position.rows() - 1
  SparseRows d_position;  // rows x 3N
  SparseRows d_velocity;  // rows x 3N, or 0 x 0 if the rows do not depend on velocity
};

// Predicted work of a Jacobian, in a unit that means nothing but that both share it.
// That of the tangent grows with steps x parameters, that of the adjoint with the sum
// over residual rows of the steps before the last frame that they depend on.
struct JacobianCosts {
  double tangent = 0.0;
  double adjoint = 0.0;
};

struct ObjectRecord;
struct PassOutcome;

class DPE_ENGINE_API Sensitivity {
 public:
  // Both must outlive this object; `rollout` must have ended with an ok status and the
  // simulator must not have run with other parameters in between.
  Sensitivity(Simulator* simulator, const Rollout* rollout);

  // dL/dp for a scalar L of the states.
  //
  // @param dl_dx  dL/dx, one 3N x F matrix per object (0 x 0: no dependence)
  // @param dl_dv  the same for velocities; an empty vector means no dependence
  // @return       one value per parameter, layout order
  Eigen::VectorXd Gradient(const std::vector<Eigen::MatrixXd>& dl_dx,
                           const std::vector<Eigen::MatrixXd>& dl_dv = {});

  // The change of all states for a change `dp` of the parameters, 3N x F per object.
  void JacobianVectorProduct(const Eigen::VectorXd& dp,
                             std::vector<Eigen::MatrixXd>* dx,
                             std::vector<Eigen::MatrixXd>* dv);

  // The Jacobian of residual rows with respect to the parameters: rows accumulate over
  // `derivatives` (several entries may name the same rows).
  //
  // @param derivatives  of rows 0 ... num_rows - 1, in any order
  // @param num_rows     number of residual rows
  // @param method       kAuto takes the cheaper of tangent and adjoint for this shape
  // @return             num_rows x layout().size()
  RowMajorMatrix Jacobian(const std::vector<StateDerivative>& derivatives, int num_rows,
                          JacobianMethod method = JacobianMethod::kAuto);

  // The same into a matrix that is resized as needed: whoever asks again and again
  // saves the system a large allocation.
  void Jacobian(const std::vector<StateDerivative>& derivatives, int num_rows,
                JacobianMethod method, RowMajorMatrix* jacobian);

  // The predicted work of Jacobian by either method.
  JacobianCosts PredictCosts(const std::vector<StateDerivative>& derivatives) const;

  // What kAuto would choose: the method with less predicted work.
  JacobianMethod CheaperMethod(const std::vector<StateDerivative>& derivatives) const;

  // Not ok after a derivative pass whose linear systems could not be solved, whose
  // result is not finite (derivatives of an unstable motion grow with every step), or
  // that was interrupted (SimulatorOptions::interrupted): object, frame, step and
  // reason of the first one. What that pass returned is then not to be used.
  const RolloutStatus& status() const { return status_; }
  bool ok() const { return status_.ok(); }

 private:
  ObjectRecord Record(int object) const;
  // Keeps the first failure.
  void Note(int object, const PassOutcome& pass);
  // Notes the first entry that is not finite; there has to be one.
  void NoteNotFinite(const std::vector<StateDerivative>& derivatives,
                     const RowMajorMatrix& jacobian);

  Simulator* simulator_;
  const Rollout* rollout_;
  RolloutStatus status_;
};

}  // namespace dpe

#endif  // DPE_ENGINE_SENSITIVITY_H_
