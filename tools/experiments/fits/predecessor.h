// What the experiments gave before: the figures of the predecessor, a thesis framework
// (C++ engine with a linearly implicit step and an approximate gradient, L-BFGS-B of
// SciPy), measured on one core of a current x86-64 machine, compiled with -O3
// -march=native; times are processor seconds. Its scenes are those of the presets, its
// start is every parameter at 1e-4 with bounds 1e-4 to 1e4. Its integrator is not ours
// (method 2 with approximate Jacobians), so that floors differ slightly.
#ifndef DPE_TOOLS_EXPERIMENTS_FITS_PREDECESSOR_H_
#define DPE_TOOLS_EXPERIMENTS_FITS_PREDECESSOR_H_

#include <string>
#include <vector>

namespace dpe::experiments {

struct PredecessorFit {
  const char* scene;
  int frames;
  const char* settings;
  double rms;        // m
  double floor;      // m
  double deviation;  // %, mean relative; NaN where one value stands for many
  double cpu;        // s
};
const std::vector<PredecessorFit>& PredecessorFits();
// Null if it was not measured.
const PredecessorFit* FindPredecessorFit(const std::string& scene, int frames,
                                         const std::string& settings);

struct PredecessorForecast {
  int frames;
  double side_rms, side_validation;  // m, over the fitted frames and over 500
  double flag_rms, flag_validation;
};
const std::vector<PredecessorForecast>& PredecessorForecasts();

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_FITS_PREDECESSOR_H_
