// Global minima of functions of one or two numbers, found without derivatives and
// without the estimator: the floors are to be independent of what is measured by them.
#ifndef DPE_TOOLS_EXPERIMENTS_FITS_MINIMIZE_H_
#define DPE_TOOLS_EXPERIMENTS_FITS_MINIMIZE_H_

#include <functional>
#include <vector>

namespace dpe::experiments {

// May be infinite where it cannot be evaluated.
using Objective = std::function<double(const std::vector<double>&)>;

struct Minimum {
  std::vector<double> at;
  double value = 0.0;
};

// All local minima of a grid of `count` points on [low, high]: the points whose
// neighbours are not lower, the lowest first, at most `max_minima`.
std::vector<Minimum> GridMinima(const Objective& objective,
                                const std::vector<double>& low,
                                const std::vector<double>& high,
                                const std::vector<int>& count, int max_minima);

// Golden section (Kiefer, 1953) on [low, high] until it is shorter than `tolerance`.
Minimum GoldenSection(const Objective& objective, double low, double high,
                      double tolerance);

// The simplex method of Nelder and Mead (1965), reflection 1, expansion 2, contraction
// and shrinkage 1/2, from a simplex of side `step` until all its values agree to
// `tolerance` relative to the lowest and its sides are shorter than 1e-5; restarted
// there once, because a simplex can collapse where there is no minimum.
Minimum NelderMead(const Objective& objective, const std::vector<double>& start,
                   double step, double tolerance);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_FITS_MINIMIZE_H_
