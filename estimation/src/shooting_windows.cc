#include "shooting_windows.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "dpe/engine/parameters.h"
#include "state_guess.h"

namespace dpe {
namespace {

PrescribedPath PathFrom(const PrescribedPath& path, int frame) {
  const int last = static_cast<int>(path.positions.cols()) - 1;
  const int first = std::min(frame, last);
  return {path.vertex, path.positions.rightCols(last - first + 1)};
}

Eigen::MatrixXd Columns(const Eigen::MatrixXd& matrix, int first, int count) {
  const int available = static_cast<int>(matrix.cols()) - first;
  if (matrix.size() == 0 || available <= 0) return {};
  return matrix.middleCols(first, std::min(count, available));
}

Observations ObservationsOf(const Observations& all, int first, int num_frames) {
  Observations window;
  window.markers = all.markers;
  window.sigma = all.sigma;
  for (const Eigen::MatrixXd& positions : all.positions) {
    window.positions.push_back(Columns(positions, first, num_frames));
    if (first > 0 && window.positions.back().size() > 0) {
      window.positions.back().col(0).setConstant(std::nan(""));
    }
  }
  for (const Eigen::MatrixXd& sigmas : all.sigmas) {
    window.sigmas.push_back(Columns(sigmas, first, num_frames));
  }
  for (MarkerSample sample : all.samples) {
    sample.time -= first;
    const bool begins = first == 0 ? sample.time >= 0.0 : sample.time > 0.0;
    if (begins && sample.time <= num_frames - 1) window.samples.push_back(sample);
  }
  return window;
}

Scene SceneFrom(const Scene& scene, const Observations& observations,
                const Trajectory& rollout, int frame) {
  Scene window = scene;
  for (int o = 0; o < static_cast<int>(scene.objects.size()); ++o) {
    ClothObject& cloth = window.objects[o];
    cloth.rest_length = RestLengths(scene.objects[o]);
    if (frame == 0 || rollout.positions[o].size() == 0) continue;  // not simulated
    cloth.estimate_initial_position = cloth.estimate_initial_velocity = true;
    const StateGuess guess =
        GuessState(scene, o, observations, rollout.positions[o].col(frame),
                   rollout.velocities[o].col(frame), frame);
    cloth.positions = guess.position;
    cloth.velocities = guess.velocity;
    for (PrescribedPath& path : cloth.prescribed_paths) path = PathFrom(path, frame);
  }
  return window;
}

}  // namespace

std::vector<ShootingWindow> CutIntoWindows(const Scene& scene,
                                           const Observations& observations,
                                           const Trajectory& rollout, int num_frames,
                                           int window_frames) {
  std::vector<ShootingWindow> windows;
  const int last_frame = num_frames - 1;
  for (int first = 0; first < last_frame;) {
    int end = first + window_frames;
    if (last_frame - end < (window_frames + 1) / 2) end = last_frame;
    ShootingWindow window;
    window.first_frame = first;
    window.num_frames = end - first + 1;
    window.scene = SceneFrom(scene, observations, rollout, first);
    window.observations = ObservationsOf(observations, first, window.num_frames);
    windows.push_back(std::move(window));
    first = end;
  }
  return windows;
}

std::vector<SegmentLink> LinkWindows(const std::vector<ShootingWindow>& windows) {
  std::vector<SegmentLink> links;
  for (int w = 0; w + 1 < static_cast<int>(windows.size()); ++w) {
    SegmentLink link;
    link.from = w;
    link.frame = windows[w].num_frames - 1;
    link.to = w + 1;
    links.push_back(link);
  }
  return links;
}

}  // namespace dpe
