// What was seen of the cloth: positions of vertices at frames, possibly with gaps, and
// of markers anywhere on it at any time.
#ifndef DPE_ESTIMATION_OBSERVATIONS_H_
#define DPE_ESTIMATION_OBSERVATIONS_H_

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "dpe/engine/scene.h"
#include "dpe/engine/trajectory.h"
#include "dpe/estimation/export.h"

namespace dpe {

// A point of the cloth that is observed: a fixed combination of vertices of one object.
struct Marker {
  std::string name;
  int object = 0;
  std::vector<int> vertices;    // one, or the three of a triangle
  std::vector<double> weights;  // barycentric coordinates, sum 1
  double distance = 0.0;        // m, from the cloth when it was attached
};

// A marker's position at a moment that need not be a frame.
struct MarkerSample {
  int marker = 0;                                      // index into markers
  double time = 0.0;                                   // in frames since frame 0, >= 0
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // m
  double sigma = 0.0;                                  // m; 0: Observations::sigma
};

struct Observations {
  // What was seen of vertices at frames. One matrix per object, 3N x F, m; NaN where a
  // vertex was not observed at a frame; 0 x 0 for objects that were not observed at
  // all.
  std::vector<Eigen::MatrixXd> positions;

  // Standard deviation of the noise on each coordinate, m, one N x F matrix per object;
  // NaN, or an empty vector or matrix: `sigma`.
  std::vector<Eigen::MatrixXd> sigmas;

  // What was seen elsewhere: between vertices or between frames.
  std::vector<Marker> markers;
  std::vector<MarkerSample> samples;

  // Standard deviation of every coordinate for which nothing else is given, m; 0: not
  // known.
  double sigma = 0.0;

  // Frames that `positions` and `samples` reach into, frame 0 included.
  DPE_ESTIMATION_API int num_frames() const;
  DPE_ESTIMATION_API bool IsObserved(int object, int vertex, int frame) const;
  // The noise of one vertex at one frame, of one sample, m; 0: not known.
  DPE_ESTIMATION_API double Sigma(int object, int vertex, int frame) const;
  DPE_ESTIMATION_API double Sigma(const MarkerSample& sample) const;
  // Number of (vertex, frame) pairs observed of one object.
  DPE_ESTIMATION_API long NumObserved(int object) const;
  // True if every free vertex of `object` is observed at every frame.
  DPE_ESTIMATION_API bool IsComplete(const Scene& scene, int object) const;
};

// All positions of a trajectory, as if every vertex had been observed.
DPE_ESTIMATION_API Observations ObserveAll(const Trajectory& trajectory);

// Adds independent normal noise to every coordinate of free vertices and of markers
// after frame 0 (which, the initial state, is given by the scene).
// @param scene  what was observed
// @param sigma  standard deviation per coordinate, m
// @param seed   of a std::mt19937_64
// @param obs    is changed
DPE_ESTIMATION_API void AddNoise(const Scene& scene, double sigma, std::uint64_t seed,
                                 Observations* obs);

// Where a simulated marker is at `time` (in frames), by a cubic through the four
// nearest of the first `num_frames` frames. The trajectory must hold the marker's
// object.
DPE_ESTIMATION_API Eigen::Vector3d MarkerPosition(const Trajectory& trajectory,
                                                  const Marker& marker, double time,
                                                  int num_frames);

// The squared distances of what was observed from a trajectory, of any number of
// motions.
struct PositionErrors {
  double sum = 0.0;  // m^2
  long count = 0;    // of observed positions

  DPE_ESTIMATION_API double Rms() const;  // m; NaN without any
};

// Adds those of vertices and of markers of the objects that the trajectory holds, over
// the frames from `first_frame` to the `num_frames`-th. Noise makes no difference:
// every observation counts the same.
DPE_ESTIMATION_API void AddPositionErrors(const Trajectory& trajectory,
                                          const Observations& observations,
                                          int num_frames, PositionErrors* errors,
                                          int first_frame = 0);

// sqrt(sum |x - x_hat|^2 / number of observed positions) of these, m; NaN without any.
DPE_ESTIMATION_API double RmsPositionError(const Trajectory& trajectory,
                                           const Observations& observations,
                                           int num_frames, int first_frame = 0);

}  // namespace dpe

#endif  // DPE_ESTIMATION_OBSERVATIONS_H_
