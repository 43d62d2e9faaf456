#include "forecast.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dpe/engine/simulator.h"
#include "fit_problem.h"
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

Forecaster::Forecaster(const EstimatorOptions& options)
    : cost_options_(CostOptionsOf(options)) {}

void Forecaster::Add(const Scene& scene, const Observations& observations,
                     int num_fitted, int num_frames) {
  Capture capture;
  capture.num_fitted = num_fitted;
  capture.num_frames = num_frames;
  capture.observations = CutFrames(observations, 0, num_frames);
  capture.held_out = HoldOut(capture.observations, num_fitted);
  capture.costs = MakePositionCosts(scene, capture.held_out, num_frames, cost_options_);
  captures_.push_back(std::move(capture));
}

void Forecaster::RequireHeldOut() const {
  std::string frames;
  for (const Capture& capture : captures_) {
    if (!capture.costs.empty()) return;
    frames += (frames.empty() ? "" : ", and ") + std::to_string(capture.num_fitted) +
              " to " + std::to_string(capture.num_frames - 1);
  }
  throw SceneError("settings auto: no free vertex is observed in the frames " + frames +
                   ", which are held out to choose by; say more or fewer --frames, or "
                   "name the settings");
}

Forecast Forecaster::Run(const std::vector<Scene>& fitted, int num_threads,
                         StopControl* stop) const {
  SimulatorOptions options;
  options.only_estimated_objects = true;
  options.num_threads = num_threads;
  options.interrupted = [stop] { return stop->Poll(); };
  PositionErrors all, held_out, moved;
  Forecast forecast;
  for (size_t c = 0; c < captures_.size(); ++c) {
    const Capture& capture = captures_[c];
    const int frames = capture.num_frames;
    Trajectory trajectory = Simulator(fitted[c], options).Simulate(frames);
    forecast.message = trajectory.status.Message();
    if (!trajectory.status.ok()) return forecast;
    AddPositionErrors(trajectory, capture.observations, frames, &all);
    AddPositionErrors(trajectory, capture.held_out, frames, &held_out);
    for (const auto& cost : capture.costs) {
      forecast.residuals.emplace_back(cost->num_residuals());
      cost->Evaluate(trajectory, forecast.residuals.back().data(), nullptr);
    }
    for (Eigen::MatrixXd& positions : trajectory.positions) {
      if (positions.size() == 0) continue;
      positions.colwise() = Eigen::VectorXd(positions.col(0));
    }
    AddPositionErrors(trajectory, capture.held_out, frames, &moved);
  }
  forecast.ok = true;
  forecast.rms = held_out.Rms();
  forecast.rms_of_all_frames = all.Rms();
  forecast.is_exact = forecast.rms <= kExact * moved.Rms();
  return forecast;
}

}  // namespace dpe
