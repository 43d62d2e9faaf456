// Multiple shooting as the way to a start for the fit of the whole motion.
#ifndef DPE_ESTIMATION_SHOOTING_START_H_
#define DPE_ESTIMATION_SHOOTING_START_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "fit_setup.h"
#include "optimizers.h"

namespace dpe {

struct ShootingStart {
  Eigen::VectorXd coordinates;  // of ParameterMap
  std::vector<std::string> notes;
};

// Fits windows of one capture that are made to join (multiple_shooting.h), from the
// given coordinates, reporting iterations to the context.
ShootingStart ShootForStart(const FitCapture& capture, const Eigen::VectorXd& start,
                            OptimizerContext* context);

}  // namespace dpe

#endif  // DPE_ESTIMATION_SHOOTING_START_H_
