// The adjoint (backward) pass for one scalar: one sweep over the steps, last to first.
#ifndef DPE_ENGINE_DERIVATIVES_GRADIENT_PASS_H_
#define DPE_ENGINE_DERIVATIVES_GRADIENT_PASS_H_

#include <Eigen/Core>

#include "derivatives/pass_outcome.h"
#include "step_reader.h"

namespace dpe {

// dL/dp through one object.
//
// @param dl_dx, dl_dv  3N x F; 0 x 0 means no dependence
// @param gradient      out: one value per system->columns().used()
// @return where and why it stopped, if it did
PassOutcome ObjectGradient(const ObjectRecord& record, const Eigen::MatrixXd& dl_dx,
                           const Eigen::MatrixXd& dl_dv, Eigen::VectorXd* gradient);

}  // namespace dpe

#endif  // DPE_ENGINE_DERIVATIVES_GRADIENT_PASS_H_
