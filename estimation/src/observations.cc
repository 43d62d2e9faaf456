#include "dpe/estimation/observations.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "frame_interpolation.h"

namespace dpe {

int Observations::num_frames() const {
  int frames = 0;
  for (const Eigen::MatrixXd& p : positions) {
    if (p.size() > 0) frames = std::max(frames, static_cast<int>(p.cols()));
  }
  for (const MarkerSample& sample : samples) {
    // A last sample just after a frame is no reason to simulate another.
    frames = std::max(frames, static_cast<int>(std::ceil(sample.time - 1e-9)) + 1);
  }
  return frames;
}

bool Observations::IsObserved(int object, int vertex, int frame) const {
  if (object >= static_cast<int>(positions.size())) return false;
  const Eigen::MatrixXd& p = positions[object];
  if (3 * vertex + 2 >= p.rows() || frame >= p.cols()) return false;
  return p.col(frame).segment<3>(3 * vertex).allFinite();
}

double Observations::Sigma(int object, int vertex, int frame) const {
  if (object < static_cast<int>(sigmas.size()) && sigmas[object].size() > 0) {
    const double own = sigmas[object](vertex, frame);
    if (!std::isnan(own)) return own;
  }
  return sigma;
}

double Observations::Sigma(const MarkerSample& sample) const {
  return sample.sigma > 0.0 ? sample.sigma : sigma;
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
  for (MarkerSample& sample : obs->samples) {
    for (int c = 0; c < 3; ++c) {
      const double noise = normal(generator);
      if (sample.time > 0.0) sample.position[c] += noise;
    }
  }
}

namespace {

void AddVertexErrors(const Trajectory& trajectory, const Observations& observations,
                     int first_frame, int num_frames, PositionErrors* errors) {
  const size_t num_objects =
      std::min(trajectory.positions.size(), observations.positions.size());
  for (size_t object = 0; object < num_objects; ++object) {
    const Eigen::MatrixXd& simulated = trajectory.positions[object];
    const Eigen::MatrixXd& observed = observations.positions[object];
    if (simulated.size() == 0 || observed.size() == 0) continue;
    const int frames =
        std::min<int>(num_frames, std::min(simulated.cols(), observed.cols()));
    for (int f = first_frame; f < frames; ++f) {
      for (int v = 0; v < simulated.rows() / 3; ++v) {
        if (!observations.IsObserved(static_cast<int>(object), v, f)) continue;
        errors->sum +=
            (simulated.col(f).segment<3>(3 * v) - observed.col(f).segment<3>(3 * v))
                .squaredNorm();
        ++errors->count;
      }
    }
  }
}

void AddSampleErrors(const Trajectory& trajectory, const Observations& observations,
                     int first_frame, int num_frames, PositionErrors* errors) {
  num_frames = std::min(num_frames, trajectory.num_frames());
  for (const MarkerSample& sample : observations.samples) {
    const Marker& marker = observations.markers[sample.marker];
    if (sample.time < first_frame || !IsWithinFrames(sample.time, num_frames) ||
        trajectory.positions[marker.object].size() == 0) {
      continue;
    }
    errors->sum +=
        (MarkerPosition(trajectory, marker, sample.time, num_frames) - sample.position)
            .squaredNorm();
    ++errors->count;
  }
}

}  // namespace

Eigen::Vector3d MarkerPosition(const Trajectory& trajectory, const Marker& marker,
                               double time, int num_frames) {
  const FrameWeights frames = InterpolateFrames(time, num_frames);
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  for (int k = 0; k < frames.count; ++k) {
    const auto state = trajectory.positions[marker.object].col(frames.first + k);
    for (size_t i = 0; i < marker.vertices.size(); ++i) {
      position += frames.weights[k] * marker.weights[i] *
                  state.segment<3>(3 * marker.vertices[i]);
    }
  }
  return position;
}

double PositionErrors::Rms() const {
  if (count == 0) return std::numeric_limits<double>::quiet_NaN();
  return std::sqrt(sum / static_cast<double>(count));
}

void AddPositionErrors(const Trajectory& trajectory, const Observations& observations,
                       int num_frames, PositionErrors* errors, int first_frame) {
  AddVertexErrors(trajectory, observations, first_frame, num_frames, errors);
  AddSampleErrors(trajectory, observations, first_frame, num_frames, errors);
}

double RmsPositionError(const Trajectory& trajectory, const Observations& observations,
                        int num_frames, int first_frame) {
  PositionErrors errors;
  AddPositionErrors(trajectory, observations, num_frames, &errors, first_frame);
  return errors.Rms();
}

}  // namespace dpe
