#include "residual_correlation.h"

#include <algorithm>
#include <vector>

#include "frame_interpolation.h"

namespace dpe {
namespace {

void AddPair(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
             ResidualCorrelation* correlation) {
  correlation->products += a.dot(b);
  correlation->squares += 0.5 * (a.squaredNorm() + b.squaredNorm());
  correlation->num_pairs += 3;
}

void AddVertices(const Trajectory& trajectory, const Observations& observations,
                 int num_frames, ResidualCorrelation* correlation) {
  const size_t num_objects =
      std::min(trajectory.positions.size(), observations.positions.size());
  for (size_t object = 0; object < num_objects; ++object) {
    const Eigen::MatrixXd& simulated = trajectory.positions[object];
    const Eigen::MatrixXd& observed = observations.positions[object];
    if (simulated.size() == 0 || observed.size() == 0) continue;
    const int o = static_cast<int>(object);
    const int frames =
        std::min<int>(num_frames, std::min(simulated.cols(), observed.cols()));
    const auto error = [&](int v, int f) -> Eigen::Vector3d {
      return simulated.col(f).segment<3>(3 * v) - observed.col(f).segment<3>(3 * v);
    };
    for (int v = 0; v < simulated.rows() / 3; ++v) {
      for (int f = 1; f < frames; ++f) {
        if (observations.IsObserved(o, v, f - 1) && observations.IsObserved(o, v, f)) {
          AddPair(error(v, f - 1), error(v, f), correlation);
        }
      }
    }
  }
}

void AddSamples(const Trajectory& trajectory, const Observations& observations,
                int num_frames, ResidualCorrelation* correlation) {
  std::vector<const MarkerSample*> samples;
  for (const MarkerSample& sample : observations.samples) {
    if (!IsWithinFrames(sample.time, num_frames)) continue;
    if (trajectory.positions[observations.markers[sample.marker].object].size() > 0) {
      samples.push_back(&sample);
    }
  }
  std::sort(samples.begin(), samples.end(), [](const auto* a, const auto* b) {
    return a->marker != b->marker ? a->marker < b->marker : a->time < b->time;
  });
  const auto error = [&](const MarkerSample& sample) -> Eigen::Vector3d {
    return MarkerPosition(trajectory, observations.markers[sample.marker], sample.time,
                          num_frames) -
           sample.position;
  };
  for (size_t i = 1; i < samples.size(); ++i) {
    if (samples[i]->marker != samples[i - 1]->marker) continue;
    AddPair(error(*samples[i - 1]), error(*samples[i]), correlation);
  }
}

}  // namespace

void CorrelateResiduals(const Trajectory& trajectory, const Observations& observations,
                        int num_frames, ResidualCorrelation* correlation) {
  num_frames = std::min(num_frames, trajectory.num_frames());
  AddVertices(trajectory, observations, num_frames, correlation);
  AddSamples(trajectory, observations, num_frames, correlation);
}

}  // namespace dpe
