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
  explicit Forecaster(const EstimatorOptions& options);

  // Adds a capture.
  // @param scene       whose modes say which objects are estimated
  // @param num_fitted  frames; what was observed later, up to `num_frames`, is held out
  void Add(const Scene& scene, const Observations& observations, int num_fitted,
           int num_frames);

  // @throws SceneError if nothing is held out
  void RequireHeldOut() const;

  // @param fitted  one scene per capture
  // @param stop    polled within rollouts
  Forecast Run(const std::vector<Scene>& fitted, int num_threads,
               StopControl* stop) const;

 private:
  struct Capture {
    int num_fitted = 0;
    int num_frames = 0;
    Observations observations;
    Observations held_out;
    TrajectoryCosts costs;
  };

  PositionCostOptions cost_options_;
  std::vector<Capture> captures_;
};

}  // namespace dpe

#endif  // DPE_ESTIMATION_FORECAST_H_
