// Jacobians of residual rows through one object, forward (tangent) and backward
// (adjoint). Both walk over the steps once and share StageLinearization; they work on
// blocks of columns (tangent) or residual rows (adjoint) of a fixed size, so that the
// result does not depend on the number of threads.
#ifndef DPE_ENGINE_DERIVATIVES_JACOBIAN_PASS_H_
#define DPE_ENGINE_DERIVATIVES_JACOBIAN_PASS_H_

#include <vector>

#include "dpe/engine/sensitivity.h"
#include "object_system.h"
#include "rollout_tape.h"

namespace dpe {

struct PassInput {
  const Scene* scene;
  const SimulatorOptions* options;
  ObjectSystem* system;
  const ObjectTape* tape;
  // The derivatives that name this object, sorted by frame.
  std::vector<const StateDerivative*> derivatives;
};

// jacobian (rows x layout columns) += by forward sensitivities. False if a step's
// system could not be solved.
bool AddTangentJacobian(const PassInput& input, RowMajorMatrix* jacobian);

// The same by one backward sweep of a block of adjoint vectors per residual row.
bool AddAdjointJacobian(const PassInput& input, RowMajorMatrix* jacobian);

// The change of the object's states for a change `dp` of the parameters (layout order):
// dx and dv become 3N x F. False as above.
bool PropagateTangent(const PassInput& input, const Eigen::VectorXd& dp, int num_frames,
                      Eigen::MatrixXd* dx, Eigen::MatrixXd* dv);

}  // namespace dpe

#endif  // DPE_ENGINE_DERIVATIVES_JACOBIAN_PASS_H_
