// Which observations a fit can do something about, and how noisy they are.
#ifndef DPE_ESTIMATION_MOVED_OBSERVATIONS_H_
#define DPE_ESTIMATION_MOVED_OBSERVATIONS_H_

#include <algorithm>
#include <vector>

#include "dpe/engine/parameters.h"
#include "dpe/engine/scene.h"
#include "dpe/estimation/observations.h"

namespace dpe {

// For each marker 1 if a parameter moves it: if its object is estimated and it takes
// part in the motion of a free vertex.
std::vector<char> MovedMarkers(const Scene& scene, const Observations& observations);

// Calls see(time, sigma, is_moved) for every observation of an estimated object in the
// first `num_frames` frames, and for every sample: its time in frames, its noise (m; 0:
// not known), and whether a parameter moves it: not fixed vertices, nor what is at
// frame 0, which is given.
template <typename See>
void ForEachObservation(const Scene& scene, const Observations& observations,
                        int num_frames, See see) {
  const std::vector<char> is_estimated = ParameterLayout::EstimatedObjects(scene);
  for (int object = 0; object < static_cast<int>(observations.positions.size());
       ++object) {
    if (is_estimated[object] == 0) continue;
    const ClothObject& cloth = scene.objects[object];
    const int frames = std::min<int>(num_frames, observations.positions[object].cols());
    for (int f = 0; f < frames; ++f) {
      for (int v = 0; v < cloth.num_vertices(); ++v) {
        if (!observations.IsObserved(object, v, f)) continue;
        see(static_cast<double>(f), observations.Sigma(object, v, f),
            f > 0 && cloth.is_fixed[v] == 0);
      }
    }
  }
  const std::vector<char> is_moved = MovedMarkers(scene, observations);
  for (const MarkerSample& sample : observations.samples) {
    see(sample.time, observations.Sigma(sample), is_moved[sample.marker] != 0);
  }
}

// The first frame, from 1 on, by which something was observed that a parameter moves;
// `num_frames` if nothing was.
int FirstMovedFrame(const Scene& scene, const Observations& observations,
                    int num_frames);

}  // namespace dpe

#endif  // DPE_ESTIMATION_MOVED_OBSERVATIONS_H_
