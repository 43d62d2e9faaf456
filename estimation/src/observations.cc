#include "dpe/estimation/observations.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace dpe {

int Observations::num_frames() const {
  int frames = 0;
  for (const Eigen::MatrixXd& p : positions) {
    if (p.size() > 0) frames = std::max(frames, static_cast<int>(p.cols()));
  }
  for (const MarkerSample& sample : samples) {
    frames = std::max(frames, static_cast<int>(std::ceil(sample.time)) + 1);
  }
  return frames;
}

bool Observations::IsObserved(int object, int vertex, int frame) const {
  if (object >= static_cast<int>(positions.size())) return false;
  const Eigen::MatrixXd& p = positions[object];
  if (3 * vertex + 2 >= p.rows() || frame >= p.cols()) return false;
  return p.col(frame).segment<3>(3 * vertex).allFinite();
}

long Observations::NumObserved(int object) const {
  if (object >= static_cast<int>(positions.size())) return 0;
  long count = 0;
  for (int f = 0; f < positions[object].cols(); ++f) {
    for (int v = 0; v < positions[object].rows() / 3; ++v) {
      if (IsObserved(object, v, f)) ++count;
    }
  }
  return count;
}

bool Observations::IsComplete(const Scene& scene, int object) const {
  if (object >= static_cast<int>(positions.size())) return false;
  if (positions[object].cols() == 0) return false;
  const ClothObject& cloth = scene.objects[object];
  for (int f = 0; f < positions[object].cols(); ++f) {
    for (int v = 0; v < cloth.num_vertices(); ++v) {
      if (!cloth.is_fixed[v] && !IsObserved(object, v, f)) return false;
    }
  }
  return true;
}

Observations ObserveAll(const Trajectory& trajectory) {
  Observations observations;
  observations.positions = trajectory.positions;
  return observations;
}

void AddNoise(const Scene& scene, double sigma, std::uint64_t seed, Observations* obs) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal(0.0, sigma);
  for (int object = 0; object < static_cast<int>(obs->positions.size()); ++object) {
    Eigen::MatrixXd& positions = obs->positions[object];
    const std::vector<char>& is_fixed = scene.objects[object].is_fixed;
    for (int f = 1; f < positions.cols(); ++f) {
      for (int row = 0; row < positions.rows(); ++row) {
        // Drawn for every coordinate, so that a vertex's noise does not depend on which
        // others are fixed. NaN (not observed) stays NaN.
        const double noise = normal(generator);
        if (!is_fixed[row / 3]) positions(row, f) += noise;
      }
    }
  }
}

double RmsPositionError(const Trajectory& trajectory, const Observations& observations,
                        int num_frames) {
  double sum = 0.0;
  long count = 0;
  const size_t num_objects =
      std::min(trajectory.positions.size(), observations.positions.size());
  for (size_t object = 0; object < num_objects; ++object) {
    const Eigen::MatrixXd& simulated = trajectory.positions[object];
    const Eigen::MatrixXd& observed = observations.positions[object];
    if (simulated.size() == 0 || observed.size() == 0) continue;
    const int frames =
        std::min<int>(num_frames, std::min(simulated.cols(), observed.cols()));
    for (int f = 0; f < frames; ++f) {
      for (int v = 0; v < simulated.rows() / 3; ++v) {
        if (!observations.IsObserved(static_cast<int>(object), v, f)) continue;
        sum += (simulated.col(f).segment<3>(3 * v) - observed.col(f).segment<3>(3 * v))
                   .squaredNorm();
        ++count;
      }
    }
  }
  if (count == 0) return std::numeric_limits<double>::quiet_NaN();
  return std::sqrt(sum / static_cast<double>(count));
}

}  // namespace dpe
