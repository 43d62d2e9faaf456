// Where the cloths of one scene are at one moment.
#ifndef DPE_VIEWER_PLAYBACK_MOTION_STATE_H_
#define DPE_VIEWER_PLAYBACK_MOTION_STATE_H_

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace dpe::viewer {

// One vector per object of the scene, 3N, xyz interleaved, m and m/s. NaN: a vertex
// that was not observed, or whose velocity is not known; an empty vector: an object
// that was not observed at all.
struct MotionState {
  std::vector<Eigen::VectorXd> positions;
  std::vector<Eigen::VectorXd> velocities;

  std::size_t bytes() const {
    std::size_t sum = 0;
    for (const auto* all : {&positions, &velocities}) {
      for (const Eigen::VectorXd& values : *all) sum += sizeof(double) * values.size();
    }
    return sum;
  }
};

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_PLAYBACK_MOTION_STATE_H_
