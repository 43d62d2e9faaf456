#include "experiments/fits/predecessor.h"

#include <limits>

namespace dpe::experiments {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

}  // namespace

const std::vector<PredecessorFit>& PredecessorFits() {
  static const std::vector<PredecessorFit> fits = {
      {"side", 100, "Gn", 0.2014, 0.1957, kNone, 63},
      {"side", 100, "Ln", 0.925, 0.0, 121, 71},
      {"side", 100, "nG", 0.0415, 0.0413, kNone, 122},
      {"side", 100, "nL", 0.0823, 0.0, 220, 129},
      {"corners", 100, "Gn", 0.0680, 0.0679, kNone, 113},
      {"corners", 100, "Ln", 0.0504, 0.0, 26, 66},
      {"corners", 100, "nG", 0.0835, 0.0834, kNone, 69},
      {"corners", 100, "nL", 0.2397, 0.0, 113, 82},
      {"flag", 20, "Gn", 2.724, 0.116, kNone, 0.4},
      {"flag", 20, "Ln", 0.557, 0.0, 5115, 24},
      {"flag", 20, "nG", 0.0172, 0.0172, kNone, 5.4},
      {"flag", 20, "nL", 1.0e-4, 0.0, 121, 269},
      {"flag", 100, "Gn", 3.369, 0.947, kNone, 2},
      {"flag", 100, "Ln", 3.09, 0.0, 2377, 110},
      {"flag", 100, "nG", 1.176, 0.514, kNone, 65},
      {"flag", 100, "nL", 0.460, 0.0, 139, 143},
  };
  return fits;
}

const PredecessorFit* FindPredecessorFit(const std::string& scene, int frames,
                                         const std::string& settings) {
  for (const PredecessorFit& fit : PredecessorFits()) {
    if (fit.scene == scene && fit.frames == frames && fit.settings == settings) {
      return &fit;
    }
  }
  return nullptr;
}

const std::vector<PredecessorForecast>& PredecessorForecasts() {
  static const std::vector<PredecessorForecast> forecasts = {
      {20, 0.0020, 0.370, 2.6e-4, 1.10}, {40, 0.0012, 0.036, 0.035, 1.35},
      {60, 0.037, 0.085, 0.187, 265},    {80, 0.062, 0.089, 0.308, 339},
      {100, 0.082, 0.101, 0.460, 1.28},  {120, 0.091, 0.120, 46, 640},
      {140, 0.086, 0.101, 72, 640},      {160, 0.094, 0.113, 101, 640},
      {180, 0.093, 0.115, 130, 640},     {200, 0.086, 0.102, 160, 640},
  };
  return forecasts;
}

}  // namespace dpe::experiments
