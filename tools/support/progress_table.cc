#include "support/progress_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "dpe/estimation/joint_layout.h"

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
  const TrueParameters truth = TrueParametersOf(input.scenes());
  Eigen::Index offset = 0;
  for (size_t b = 0; b < summary.blocks.size(); ++b) {
    const EstimatedBlock& block = summary.blocks[b];
    std::string owner =
        block.object >= 0 ? "object " + std::to_string(block.object) : "scene";
    if (block.capture >= 0) {
      owner = "capture " + std::to_string(block.capture + 1) + " " + owner;
    }
    std::cout << owner << " " << block.kind << " (" << ModeName(block.mode) << ", "
              << block.values.size() << "): " << Describe(block.values, block.unit)
              << "\n";
    if (input.truth_is_known && truth.is_known[b]) {
      std::cout << "  true: "
                << Describe(truth.values.segment(offset, block.values.size()),
                            block.unit)
                << "\n";
    }
    offset += block.values.size();
    if (!block.inactive.empty()) {
      std::cout << "  " << block.inactive.size()
                << " more have no influence on the motion and were left as they are\n";
    }
  }
}

void PrintErrors(const EstimatorSummary& summary,
                 const std::vector<Validation>& validations) {
  const Validation all = Together(validations);
  std::cout << "RMS position error over the " << summary.num_frames
            << " fitted frames: " << Format(summary.final_rms) << " m\n";
  if (all.num_frames > 0) {
    std::cout << "RMS position error over " << all.num_frames
              << " frames (validation): " << Format(all.rms) << " m\n";
  }
  const bool are_several = validations.size() > 1;
  if (std::isfinite(all.held_out_rms)) {
    const std::string frames =
        are_several ? "" : std::to_string(all.num_frames - summary.num_frames) + " ";
    std::cout << "RMS position error over the " << frames
              << "frames after them (held out): " << Format(all.held_out_rms) << " m\n";
  }
  for (size_t c = 0; c < validations.size(); ++c) {
    const std::string capture = "capture " + std::to_string(c + 1);
    if (are_several) {
      std::cout << "  " << capture << ": " << Format(summary.captures[c].final_rms)
                << " m over " << summary.captures[c].num_frames << " frames";
      if (validations[c].num_frames > 0) {
        std::cout << ", " << Format(validations[c].rms) << " m over "
                  << validations[c].num_frames << " (validation)";
      }
      if (std::isfinite(validations[c].held_out_rms)) {
        std::cout << ", " << Format(validations[c].held_out_rms) << " m over the "
                  << validations[c].num_frames - summary.captures[c].num_frames
                  << " held out";
      }
      std::cout << "\n";
    }
    if (validations[c].note.empty()) continue;
    std::cout << "Note: " << (are_several ? capture + ": " : "") << validations[c].note
              << "\n";
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

void PrintTask(const EstimationInput& input) {
  const CaptureInput& first = input.captures[0];
  const JointLayout joint(input.scenes(), /*own_wind=*/true);
  const std::string settings = input.auto_objects.empty()
                                   ? SettingsString(first.scene) + ": " +
                                         std::to_string(joint.layout().size()) +
                                         " parameters"
                                   : "auto: models";
  const auto describe_scene = [](const CaptureInput& capture) {
    return capture.scene_path.empty() ? "made of the target" : capture.scene_path;
  };
  const auto describe_target = [](const CaptureInput& capture) {
    return std::to_string(capture.num_frames) + " frames of " +
           (capture.target_path.empty() ? "the scene's own motion"
                                        : capture.target_path);
  };
  if (input.captures.size() == 1) {
    std::cout << "Scene " << describe_scene(first) << ", settings " << settings
              << " to fit to " << describe_target(first) << std::endl;
    return;
  }
  std::cout << "Settings " << settings << " to fit to " << input.captures.size()
            << " captures\n";
  for (size_t c = 0; c < input.captures.size(); ++c) {
    std::cout << "Capture " << c + 1 << ": scene " << describe_scene(input.captures[c])
              << ", " << describe_target(input.captures[c]) << "\n";
  }
  std::cout << std::flush;
}

void PrintSummary(const EstimationInput& input, const EstimatorSummary& summary,
                  const std::vector<Validation>& validations,
                  const std::vector<std::string>& files) {
  std::cout << "\n"
            << TerminationName(summary.termination) << ": " << summary.message << "\n"
            << "Start " << summary.init << ", solver " << summary.solver << " ("
            << summary.solver_reason << ")\n"
            << summary.iterations << " iterations, " << summary.evaluations
            << " rollouts, " << summary.jacobian_evaluations << " derivative passes, "
            << Format(summary.wall_time_s) << " s\n";
  for (const std::string& note : summary.notes) std::cout << "Note: " << note << "\n";
  if (std::isfinite(summary.final_cost)) {
    PrintErrors(summary, validations);
    std::cout.flush();  // the table goes past it
    PrintSmoothness(summary);
    PrintBlocks(input, summary);
    PrintUncertainty(summary.uncertainty);
    if (summary.sensitivity.ok) std::cout << summary.sensitivity.text << "\n";
    if (input.truth_is_known) {
      const double deviation = ParameterDeviationPercent(summary, input.scenes());
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
