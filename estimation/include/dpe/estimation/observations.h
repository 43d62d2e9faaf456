// What was seen of the cloth: vertex positions, frame by frame, possibly with gaps.
#ifndef DPE_ESTIMATION_OBSERVATIONS_H_
#define DPE_ESTIMATION_OBSERVATIONS_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "dpe/engine/scene.h"
#include "dpe/engine/trajectory.h"

namespace dpe {

struct Observations {
  // One matrix per object, 3N x F, m; NaN where a vertex was not observed at a frame;
  // 0 x 0 for objects that were not observed at all.
  std::vector<Eigen::MatrixXd> positions;

  int num_frames() const;
  bool IsObserved(int object, int vertex, int frame) const;
  // Number of (vertex, frame) pairs observed of one object.
  long NumObserved(int object) const;
  // True if every free vertex of `object` is observed at every frame.
  bool IsComplete(const Scene& scene, int object) const;
};

// All positions of a trajectory, as if every vertex had been observed.
Observations ObserveAll(const Trajectory& trajectory);

// Adds independent normal noise to every coordinate of free vertices from frame 1 on
// (frame 0, the initial state, is given by the scene).
// @param sigma  standard deviation per coordinate, m
// @param seed   of a std::mt19937_64
void AddNoise(const Scene& scene, double sigma, std::uint64_t seed, Observations* obs);

// sqrt(sum |x - x_hat|^2 / number of observed vertex positions), m, over the first
// `num_frames` frames of the objects that the trajectory holds; NaN without any.
double RmsPositionError(const Trajectory& trajectory, const Observations& observations,
                        int num_frames);

}  // namespace dpe

#endif  // DPE_ESTIMATION_OBSERVATIONS_H_
