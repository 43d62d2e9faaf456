#include "fit_summary.h"

#include <limits>
#include <utility>

namespace dpe {

void SummariseCaptures(const std::vector<CaptureView>& captures, bool has_result,
                       FitProblem* fit, EstimatorSummary* summary) {
  for (int c = 0; c < static_cast<int>(captures.size()); ++c) {
    CaptureSummary capture;
    capture.scene = *captures[c].scene;
    fit->problem()->layout().Insert(summary->parameters, &capture.scene, c);
    capture.num_frames = fit->captures()[c].num_frames;
    capture.final_rms =
        has_result ? fit->best_rms(c) : std::numeric_limits<double>::quiet_NaN();
    summary->captures.push_back(std::move(capture));
  }
  summary->scene = summary->captures[0].scene;
}

void FindSensitivity(const EstimatorOptions& options, StopControl* stop,
                     EstimatorSummary* summary) {
  SimulatorOptions simulator_options;
  simulator_options.num_threads = options.num_threads;
  simulator_options.memory_limit_bytes = options.memory_limit_bytes;
  simulator_options.interrupted = [stop] { return stop->Poll(); };
  for (CaptureSummary& capture : summary->captures) {
    capture.sensitivity =
        ComputeMotionSensitivity(capture.scene, capture.num_frames, simulator_options);
    if (!summary->sensitivity.ok ||
        capture.sensitivity.growth > summary->sensitivity.growth) {
      summary->sensitivity = capture.sensitivity;
    }
  }
}

}  // namespace dpe
