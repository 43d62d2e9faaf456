// What a Jacobian costs by either pass, predicted from sizes alone so that the choice
// between them is the same in every run.
//
// Both passes linearise and factorise every stage of the steps up to the last frame
// that rows read; this fixed part is common to them, except that the solver may take
// another way for another number of columns. On it come, per stage,
//   tangent:  columns (S + P) + e E          (columns: parameters),
//   adjoint:  active rows (S + P + e E)      (active: their last frame is not before),
// where S is a solve with one right-hand side, P the products with Rx and Rv, E the
// entries of B, which the tangent adds to its columns once and the adjoint multiplies
// into every row. At the end the tangent adds its columns to each row that reads a
// state. Work on blocks of kPassBlock is shared out among threads, so that t threads
// save nothing where there is one block.
#ifndef DPE_ENGINE_DERIVATIVES_JACOBIAN_COST_H_
#define DPE_ENGINE_DERIVATIVES_JACOBIAN_COST_H_

#include "derivatives/jacobian_pass.h"

namespace dpe {

// Of one object. The unit is one instruction of vectorised code (four numbers wide);
// the coefficients were counted, see jacobian_cost.cc.
JacobianCosts PredictJacobianCosts(const ObjectRecord& record,
                                   const StateDerivatives& derivatives);

}  // namespace dpe

#endif  // DPE_ENGINE_DERIVATIVES_JACOBIAN_COST_H_
