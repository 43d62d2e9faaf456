// Energy and momenta of a cloth that nothing holds, pulls or damps: what an integrator
// adds to or takes from a motion that conserves all of them.
#ifndef DPE_TOOLS_EXPERIMENTS_STABILITY_ENERGY_HISTORY_H_
#define DPE_TOOLS_EXPERIMENTS_STABILITY_ENERGY_HISTORY_H_

#include <string>
#include <vector>

#include "dpe/engine/scene.h"
#include "experiments/record.h"

namespace dpe::experiments {

// E = sum m v^2 / 2 + sum k (l - L0)^2 / 2 of one state (J).
double Energy(const ClothObject& object, const Eigen::VectorXd& x,
              const Eigen::VectorXd& v);

// The cloth turns and swings at about 1 m/s for 4 s, in steps of 4 ms. Columns:
//   result, why      "ok", or "failed" and the status
//   time, energy, momentum, angular_momentum   samples, separated by spaces: s;
//       E / E(0); |P - P(0)| / sum m |v(0)|; |L - L(0)| / |L(0)|
//   energy_end, momentum_drift, angular_drift  the last, and the largest two
Record EnergyHistory(IntegrationMethod method);

// The numbers of such a column.
std::vector<double> ParseSamples(const std::string& text);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_STABILITY_ENERGY_HISTORY_H_
