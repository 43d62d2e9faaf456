#include "moved_observations.h"

#include <cmath>

#include "frame_interpolation.h"

namespace dpe {

std::vector<char> MovedMarkers(const Scene& scene, const Observations& observations) {
  if (observations.markers.empty()) return {};
  const std::vector<char> is_estimated = ParameterLayout::EstimatedObjects(scene);
  std::vector<char> is_moved;
  for (const Marker& marker : observations.markers) {
    is_moved.push_back(0);
    if (is_estimated[marker.object] == 0) continue;
    for (size_t i = 0; i < marker.vertices.size(); ++i) {
      if (marker.weights[i] != 0.0 &&
          !scene.objects[marker.object].is_fixed[marker.vertices[i]]) {
        is_moved.back() = 1;
      }
    }
  }
  return is_moved;
}

int FirstMovedFrame(const Scene& scene, const Observations& observations,
                    int num_frames) {
  int first = num_frames;
  ForEachObservation(scene, observations, num_frames,
                     [&](double time, double /*sigma*/, bool is_moved) {
                       if (!is_moved || IsWithinFrames(time, 1)) return;
                       while (first > 1 && IsWithinFrames(time, first)) --first;
                     });
  return first;
}

}  // namespace dpe
