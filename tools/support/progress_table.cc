#include "support/progress_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "dpe/engine/parameters.h"

namespace dpe::tools {
namespace {

constexpr double kTickInterval = 0.2;  // s

std::string Format(double value) {
  if (!std::isfinite(value)) return "unknown";
  char text[32];
  std::snprintf(text, sizeof(text), "%.4g", value);
  return text;
}

const char* ModeName(char mode) {
  switch (mode) {
    case 'G':
      return "one value";
    case 'R':
      return "one per group";
    default:
      return "one per element";
  }
}

// "0.0405 kg", or the least, the median and the greatest of many values.
std::string Describe(Eigen::VectorXd values, const std::string& unit) {
  const std::string suffix = unit == "1" ? "" : " " + unit;
  if (values.size() <= 6) {
    std::string text;
    for (const double value : values)
      text += (text.empty() ? "" : ", ") + Format(value);
    return text + suffix;
  }
  std::sort(values.begin(), values.end());
  return "min " + Format(values[0]) + ", median " + Format(values[values.size() / 2]) +
         ", max " + Format(values[values.size() - 1]) + suffix;
}

void PrintBlocks(const EstimationInput& input, const EstimatorSummary& summary) {
  const ParameterLayout layout(input.scene);
  const Eigen::VectorXd truth = layout.Extract(input.scene);
  for (size_t b = 0; b < summary.blocks.size(); ++b) {
    const EstimatedBlock& block = summary.blocks[b];
    const std::string owner =
        block.object >= 0 ? "object " + std::to_string(block.object) : "scene";
    std::cout << owner << " " << block.kind << " (" << ModeName(block.mode) << ", "
              << block.values.size() << "): " << Describe(block.values, block.unit)
              << "\n";
    if (input.truth_is_known && layout.Represents(input.scene, static_cast<int>(b))) {
      const ParameterBlock& place = layout.blocks()[b];
      std::cout << "  true: "
                << Describe(truth.segment(place.offset, place.size), block.unit)
                << "\n";
    }
    if (!block.inactive.empty()) {
      std::cout << "  " << block.inactive.size()
                << " more have no influence on the motion and were left as they are\n";
    }
  }
}

void PrintSmoothness(const EstimatorSummary& summary) {
  if (summary.smoothness_candidates.empty()) return;
  std::printf("%16s %14s %14s %17s\n", "smoothness", "training cost", "held-out cost",
              "held-out RMS (m)");
  for (const SmoothnessCandidate& candidate : summary.smoothness_candidates) {
    std::printf("%16g %14.6g %14.6g %17.5g%s%s\n", candidate.weight,
                candidate.training_cost, candidate.held_out_cost,
                candidate.held_out_rms, candidate.is_chosen ? "  chosen" : "",
                candidate.message.empty() ? "" : ("  " + candidate.message).c_str());
  }
  std::fflush(stdout);
}

void PrintUncertainty(const Uncertainty& uncertainty) {
  if (!uncertainty.ok) std::cout << "Error bars: none, ";
  for (const std::string& line : UncertaintyLines(uncertainty)) {
    std::cout << line << "\n";
  }
}

}  // namespace

void ProgressTable::PrintHeader() const {
  std::printf("%9s %7s %12s %12s %10s %9s\n", "iteration", "frames", "cost", "RMS (m)",
              "step", "time (s)");
  std::fflush(stdout);
}

void ProgressTable::EraseLine() const {
  if (line_is_drawn_) std::printf("\r%60s\r", "");
}

void ProgressTable::PrintIteration(const IterationReport& report) {
  const std::lock_guard<std::mutex> lock(mutex_);
  EraseLine();
  line_is_drawn_ = false;
  std::printf("%9d %7d %12.5g %12.5g %10.3g %9.2f%s\n", report.iteration,
              report.num_frames, report.cost, report.rms, report.step_norm,
              report.seconds, report.step_accepted ? "" : "  rejected");
  std::fflush(stdout);
  next_iteration_ = report.iteration + 1;
  last_tick_ = report.seconds;
}

void ProgressTable::Tick(double seconds) {
  if (!is_terminal_) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (seconds - last_tick_ < kTickInterval) return;
  last_tick_ = seconds;
  std::printf("\riteration %d, %.1f s ...", next_iteration_, seconds);
  std::fflush(stdout);
  line_is_drawn_ = true;
}

void PrintTask(const EstimationJob& job, const EstimationInput& input) {
  const ParameterLayout layout(input.scene);
  std::cout << "Scene "
            << (job.scene_path.empty() ? "made of the target" : job.scene_path)
            << ", settings " << SettingsString(input.scene) << ": " << layout.size()
            << " parameters to fit to " << input.num_frames << " frames of "
            << (job.target_path.empty() ? "the scene's own motion" : job.target_path)
            << std::endl;
}

void PrintSummary(const EstimationInput& input, const EstimatorSummary& summary,
                  const Validation& validation, const std::vector<std::string>& files) {
  std::cout << "\n"
            << TerminationName(summary.termination) << ": " << summary.message << "\n"
            << "Start " << summary.init << ", solver " << summary.solver << " ("
            << summary.solver_reason << ")\n"
            << summary.iterations << " iterations, " << summary.evaluations
            << " rollouts, " << summary.jacobian_evaluations << " derivative passes, "
            << Format(summary.wall_time_s) << " s\n";
  for (const std::string& note : summary.notes) std::cout << "Note: " << note << "\n";
  if (std::isfinite(summary.final_cost)) {
    std::cout << "RMS position error over the " << summary.num_frames
              << " fitted frames: " << Format(summary.final_rms) << " m\n";
    if (validation.num_frames > 0) {
      std::cout << "RMS position error over " << validation.num_frames
                << " frames (validation): " << Format(validation.rms) << " m\n";
    }
    if (std::isfinite(validation.held_out_rms)) {
      std::cout << "RMS position error over the "
                << validation.num_frames - summary.num_frames
                << " frames after them (held out): " << Format(validation.held_out_rms)
                << " m\n";
    }
    if (!validation.note.empty()) std::cout << "Note: " << validation.note << "\n";
    std::cout.flush();  // the table goes past it
    PrintSmoothness(summary);
    PrintBlocks(input, summary);
    PrintUncertainty(summary.uncertainty);
    if (summary.sensitivity.ok) std::cout << summary.sensitivity.text << "\n";
    if (input.truth_is_known) {
      const double deviation = ParameterDeviationPercent(summary, input.scene);
      std::cout << "Mean deviation from the true parameters: " << Format(deviation)
                << (std::isfinite(deviation) ? " %\n" : "\n");
    }
  }
  std::cout << "Files:\n";
  // A sequence of frames by its first and last.
  for (size_t i = 0; i < files.size(); ++i) {
    const bool is_middle = i > 2 && i + 2 < files.size() && files.size() > 4;
    if (!is_middle) std::cout << "  " << files[i] << "\n";
    if (is_middle && i == 3) std::cout << "  ...\n";
  }
}

}  // namespace dpe::tools
