// Simulating a fitted scene on over frames that it was not fitted to.
#ifndef DPE_ESTIMATION_FORECAST_H_
#define DPE_ESTIMATION_FORECAST_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "dpe/engine/scene.h"
#include "dpe/estimation/estimator.h"
#include "dpe/estimation/observations.h"
#include "dpe/estimation/trajectory_cost.h"
#include "stop_control.h"

namespace dpe {

struct Forecast {
  bool ok = false;
  std::string message;  // why not
  double rms = 0.0;     // m, over the held-out frames
  double rms_of_all_frames = 0.0;
  // As the fit's cost has them (whitened, robust), one vector per cost, in the order of
  // time.
  std::vector<Eigen::VectorXd> residuals;
  // True if the forecast is as good as if there were no noise and no error in the
  // model: to 1e-6 of what the cloth has moved, which is the rounding of single
  // precision.
  bool is_exact = false;
};

class Forecaster {
 public:
  // @param scene       whose modes say which objects are estimated
  // @param num_fitted  frames; what was observed later, up to `num_frames`, is held out
  // @param stop        polled within rollouts; must outlive this
  // @throws SceneError if nothing was
  Forecaster(const Scene& scene, const Observations& observations, int num_fitted,
             int num_frames, const EstimatorOptions& options, StopControl* stop);

  Forecast Run(const Scene& fitted) const;

 private:
  int num_frames_;
  Observations observations_;
  Observations held_out_;
  TrajectoryCosts costs_;
  int num_threads_;
  StopControl* stop_;
};

}  // namespace dpe

#endif  // DPE_ESTIMATION_FORECAST_H_
