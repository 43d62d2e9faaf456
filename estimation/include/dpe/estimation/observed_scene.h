// What a scene takes over from the observation: where it starts and how its pins move.
#ifndef DPE_ESTIMATION_OBSERVED_SCENE_H_
#define DPE_ESTIMATION_OBSERVED_SCENE_H_

#include <string>

#include "dpe/engine/scene.h"
#include "dpe/estimation/export.h"
#include "dpe/estimation/observations.h"

namespace dpe {

// Fixed vertices of observed objects follow the observation: their prescribed path is
// the observed position at each of its frames, linearly interpolated in time,
//
//   x(t) = x_a + (t - t_a) / (t_b - t_a) (x_b - x_a),  t_a <= t <= t_b
//
// between the neighbouring observations a and b, and constant before the first and
// after the last. The vertex itself is moved to where its path begins; rest lengths
// stay what they were. A vertex is observed where it is in `positions`, or by a marker
// that is attached to it alone. One that is not observed keeps the path it has.
//
// @param observations  positions, m
// @param name          stands for the observation in messages
// @param scene         whose fixed vertices get paths
// @return              how many vertices follow
// @throws SceneError for a fixed vertex that is never observed and has no path
DPE_ESTIMATION_API int FollowObservedPins(const Observations& observations,
                                          const std::string& name, Scene* scene);

// Vertices that were observed at frame 0 start there; the others, and all that are seen
// through markers only, keep the scene's positions. Rest lengths stay what they were.
// @return  how many vertices were moved
DPE_ESTIMATION_API int StartFromObservation(const Observations& observations,
                                            Scene* scene);

}  // namespace dpe

#endif  // DPE_ESTIMATION_OBSERVED_SCENE_H_
