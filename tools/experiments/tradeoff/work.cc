#include "experiments/tradeoff/work.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dpe::experiments::tradeoff {

double Work(const Record& row, const WorkWeights& weights) {
  const auto count = [&](const char* key) {
    return row.Number(key, std::numeric_limits<double>::quiet_NaN());
  };
  const double common = count("forces") + weights.assembly * count("assemblies");
  if (row.Text("solver", "") == "cg") {
    // A solve to 1e-8 takes about 1.6 times the iterations of one to 1e-5.
    const double digits = -std::log10(row.Number("tolerance", 1e-5));
    const double effort = std::max(0.5, digits / 5.0);
    return common + weights.krylov_solve * effort * count("solves");
  }
  return common + weights.factorisation * count("factorisations") +
         weights.solve * count("solves");
}

}  // namespace dpe::experiments::tradeoff
