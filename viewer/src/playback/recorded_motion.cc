#include "playback/recorded_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dpe::viewer {
namespace {

// Where a marker is on a cloth.
Eigen::Vector3d OnCloth(const Marker& marker, const Eigen::VectorXd& positions) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (size_t k = 0; k < marker.vertices.size(); ++k) {
    sum += marker.weights[k] * positions.segment<3>(3 * marker.vertices[k]);
  }
  return sum;
}

}  // namespace

bool RecordedMotion::shows_vertices() const {
  return std::any_of(observations_.positions.begin(), observations_.positions.end(),
                     [](const Eigen::MatrixXd& p) { return p.size() > 0; });
}

MotionState RecordedMotion::At(int frame) const {
  MotionState state;
  for (const Eigen::MatrixXd& all : observations_.positions) {
    if (all.size() == 0) {
      state.positions.emplace_back();
      state.velocities.emplace_back();
      continue;
    }
    const int last = static_cast<int>(all.cols()) - 1;
    const int f = std::clamp(frame, 0, last);
    const int before = std::max(f - 1, 0), after = std::min(f + 1, last);
    state.positions.push_back(all.col(f));
    if (after > before) {
      state.velocities.push_back((all.col(after) - all.col(before)) /
                                 (delta_ * (after - before)));
    } else {
      state.velocities.push_back(Eigen::VectorXd::Zero(all.rows()));
    }
  }
  return state;
}

std::vector<SeenMarker> RecordedMotion::MarkersAt(int frame) const {
  // Samples are in the order of time.
  const auto begins_before = [](const MarkerSample& sample, double time) {
    return sample.time < time;
  };
  const std::vector<MarkerSample>& samples = observations_.samples;
  std::vector<SeenMarker> seen;
  for (auto s =
           std::lower_bound(samples.begin(), samples.end(), frame - 0.5, begins_before);
       s != samples.end() && s->time < frame + 0.5; ++s) {
    seen.push_back({&observations_.markers[s->marker], s->position});
  }
  return seen;
}

RecordedMotion LoadRecordedMotion(const std::string& path, const TargetOptions& options,
                                  Scene* scene, std::vector<std::string>* warnings) {
  return RecordedMotion(LoadTarget(path, options, scene, warnings), scene->delta);
}

double RmsDistance(const RecordedMotion& target, int frame, const MotionState& state) {
  double sum = 0.0;
  long count = 0;
  const auto add = [&](const Eigen::Vector3d& distance) {
    if (!distance.allFinite()) return;
    sum += distance.squaredNorm();
    ++count;
  };
  if (frame < target.num_frames()) {
    const auto& all = target.observations().positions;
    for (size_t o = 0; o < std::min(all.size(), state.positions.size()); ++o) {
      const Eigen::VectorXd& x = state.positions[o];
      if (frame >= all[o].cols() || x.size() != all[o].rows()) continue;
      for (Eigen::Index c = 0; c < x.size(); c += 3) {
        add(x.segment<3>(c) - all[o].block<3, 1>(c, frame));
      }
    }
    for (const SeenMarker& seen : target.MarkersAt(frame)) {
      add(OnCloth(*seen.marker, state.positions[seen.marker->object]) - seen.position);
    }
  }
  return count > 0 ? std::sqrt(sum / count) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace dpe::viewer
