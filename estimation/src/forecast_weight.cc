#include "forecast_weight.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace dpe {
namespace {

// Two deviations: chance alone makes a useless parameter look useful in 1 of 40 cases.
constexpr double kDeviations = 2.0;

// Few enough that a block is longer than the noise remembers, many enough to tell
// their scatter.
constexpr int kMaxBlocks = 8;

}  // namespace

bool ForecastWeight::RicherIsBetter() const {
  return weight - kDeviations * deviation > 0.5;
}

ForecastWeight WeighForecasts(const std::vector<Eigen::VectorXd>& simpler,
                              const std::vector<Eigen::VectorXd>& richer) {
  assert(simpler.size() == richer.size());
  const int num_frames = static_cast<int>(simpler.size());
  double rd = 0.0, dd = 0.0;
  Eigen::Index n = 0;
  for (int f = 0; f < num_frames; ++f) {
    const Eigen::VectorXd d = simpler[f] - richer[f];
    rd += simpler[f].dot(d);
    dd += d.squaredNorm();
    n += d.size();
  }
  ForecastWeight result;
  if (!(dd > 0.0)) return result;
  result.weight = rd / dd;

  const int num_blocks = std::min(num_frames, kMaxBlocks);
  Eigen::VectorXd scores = Eigen::VectorXd::Zero(num_blocks);  // D_b.u_b
  double uu = 0.0;
  for (int f = 0; f < num_frames; ++f) {
    const Eigen::VectorXd d = simpler[f] - richer[f];
    const Eigen::VectorXd u = simpler[f] - result.weight * d;
    uu += u.squaredNorm();
    scores[f * num_blocks / num_frames] += d.dot(u);
  }
  double variance = n > 1 ? uu / (static_cast<double>(n) - 1.0) / dd : 0.0;
  if (num_blocks > 1) {
    variance = std::max(
        variance, num_blocks / (num_blocks - 1.0) * scores.squaredNorm() / (dd * dd));
  }
  result.deviation = std::sqrt(variance);
  return result;
}

}  // namespace dpe
