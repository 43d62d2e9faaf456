// Jacobians of residual rows through one object, forward (tangent) and backward
// (adjoint). Both walk over the steps once and share StageLinearization; they work on
// blocks of columns (tangent) or residual rows (adjoint) of a fixed size, so that the
// result does not depend on the number of threads.
#ifndef DPE_ENGINE_DERIVATIVES_JACOBIAN_PASS_H_
#define DPE_ENGINE_DERIVATIVES_JACOBIAN_PASS_H_

#include <vector>

#include "derivatives/pass_outcome.h"
#include "dpe/engine/sensitivity.h"
#include "step_reader.h"

namespace dpe {

// Derivatives that name one object, sorted by frame.
using StateDerivatives = std::vector<const StateDerivative*>;

// Tangent columns and adjoint rows that are worked on together: as many as keep a
// block's sparse products within a second-level cache at a few hundred unknowns, and
// enough for solves to run at the speed of matrix products.
constexpr int kPassBlock = 96;

// jacobian (rows x layout columns) += by forward sensitivities.
PassOutcome AddTangentJacobian(const ObjectRecord& record,
                               const StateDerivatives& derivatives,
                               RowMajorMatrix* jacobian);

// The same by one backward sweep of a block of adjoint vectors per residual row.
PassOutcome AddAdjointJacobian(const ObjectRecord& record,
                               const StateDerivatives& derivatives,
                               RowMajorMatrix* jacobian);

// The change of the object's states for a change `dp` of the parameters (layout order):
// dx and dv become 3N x F.
PassOutcome PropagateTangent(const ObjectRecord& record, const Eigen::VectorXd& dp,
                             Eigen::MatrixXd* dx, Eigen::MatrixXd* dv);

}  // namespace dpe

#endif  // DPE_ENGINE_DERIVATIVES_JACOBIAN_PASS_H_
