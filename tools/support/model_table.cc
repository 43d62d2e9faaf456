#include "support/model_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace dpe::tools {
namespace {

constexpr char kSettings[] = "settings";

std::string Number(double value) {
  if (!std::isfinite(value)) return "-";
  char text[32];
  std::snprintf(text, sizeof(text), "%.4g", value);
  return text;
}

std::string Weight(const ModelCandidate& candidate) {
  if (!std::isfinite(candidate.weight)) return "-";
  char text[64];
  std::snprintf(text, sizeof(text), "%.3g +- %.2g", candidate.weight,
                candidate.weight_deviation);
  return text;
}

}  // namespace

void PrintModelFit(const ModelFit& fit) {
  std::printf("%s %s: %d parameter%s, %d frames\n",
              fit.is_final ? "Chosen" : "Candidate", fit.settings.c_str(),
              fit.num_parameters, fit.num_parameters == 1 ? "" : "s", fit.num_frames);
  std::fflush(stdout);
}

void PrintModelSelection(const ModelSelection& selection) {
  size_t width = sizeof(kSettings) - 1;
  for (const ModelCandidate& candidate : selection.candidates) {
    width = std::max(width, candidate.settings.size());
  }
  const int w = static_cast<int>(width);
  std::printf("\nCandidates, fitted to %d frames, compared on the other %d:\n",
              selection.num_fitted_frames,
              selection.num_frames - selection.num_fitted_frames);
  std::printf("%-*s %10s %12s %12s %18s  %s\n", w, kSettings, "parameters",
              "fit RMS (m)", "forecast (m)", "weight", "kept");
  for (const ModelCandidate& candidate : selection.candidates) {
    std::printf("%-*s %10d %12s %12s %18s  %-4s %s\n", w, candidate.settings.c_str(),
                candidate.num_parameters, Number(candidate.fit_rms).c_str(),
                Number(candidate.held_out_rms).c_str(), Weight(candidate).c_str(),
                candidate.kept ? "yes" : "no", candidate.reason.c_str());
  }
  std::printf("Chosen: %s\n", selection.reason.c_str());
  std::fflush(stdout);
}

}  // namespace dpe::tools
