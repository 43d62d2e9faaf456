#include "forecast.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dpe/engine/simulator.h"
#include "fit_setup.h"
#include "frame_interpolation.h"

namespace dpe {
namespace {

constexpr double kExact = 1e-6;  // of what the cloth has moved

// What was observed later than the last of `num_fitted` frames.
Observations HoldOut(Observations observations, int num_fitted) {
  for (Eigen::MatrixXd& positions : observations.positions) {
    const int known = std::min<int>(num_fitted, positions.cols());
    positions.leftCols(known).setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  auto& samples = observations.samples;
  samples.erase(std::remove_if(samples.begin(), samples.end(),
                               [&](const MarkerSample& sample) {
                                 return IsWithinFrames(sample.time, num_fitted);
                               }),
                samples.end());
  return observations;
}

}  // namespace

Forecaster::Forecaster(const Scene& scene, const Observations& observations,
                       int num_fitted, int num_frames, const EstimatorOptions& options,
                       StopControl* stop)
    : num_frames_(num_frames),
      observations_(CutFrames(observations, 0, num_frames)),
      held_out_(HoldOut(observations_, num_fitted)),
      num_threads_(options.num_threads),
      stop_(stop) {
  PositionCostOptions cost_options;
  cost_options.loss = options.loss;
  cost_options.loss_scale = options.loss_scale;
  costs_ = MakePositionCosts(scene, held_out_, num_frames, cost_options);
  if (costs_.empty()) {
    throw SceneError(
        "settings auto: no free vertex is observed in the frames " +
        std::to_string(num_fitted) + " to " + std::to_string(num_frames - 1) +
        ", which are held out to choose by; say more or fewer --frames, or "
        "name the settings");
  }
}

Forecast Forecaster::Run(const Scene& fitted) const {
  SimulatorOptions options;
  options.only_estimated_objects = true;
  options.num_threads = num_threads_;
  options.interrupted = [this] { return stop_->Poll(); };
  Trajectory trajectory = Simulator(fitted, options).Simulate(num_frames_);
  Forecast forecast;
  if (!trajectory.status.ok()) {
    forecast.message = trajectory.status.Message();
    return forecast;
  }
  forecast.ok = true;
  forecast.rms = RmsPositionError(trajectory, held_out_, num_frames_);
  forecast.rms_of_all_frames = RmsPositionError(trajectory, observations_, num_frames_);
  for (const auto& cost : costs_) {
    forecast.residuals.emplace_back(cost->num_residuals());
    forecast.ok = forecast.ok &&
                  cost->Evaluate(trajectory, forecast.residuals.back().data(), nullptr);
  }
  for (Eigen::MatrixXd& positions : trajectory.positions) {
    if (positions.size() == 0) continue;
    positions.colwise() = Eigen::VectorXd(positions.col(0));
  }
  const double moved = RmsPositionError(trajectory, held_out_, num_frames_);
  forecast.is_exact = forecast.rms <= kExact * moved;
  return forecast;
}

}  // namespace dpe
