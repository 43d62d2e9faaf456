// From a recording to observations of a cloth: which point of the cloth is which
// marker.
#ifndef DPE_ESTIMATION_ATTACH_H_
#define DPE_ESTIMATION_ATTACH_H_

#include <map>
#include <string>
#include <vector>

#include "dpe/engine/scene.h"
#include "dpe/estimation/capture.h"
#include "dpe/estimation/export.h"
#include "dpe/estimation/observations.h"

namespace dpe {

enum class AttachMethod {
  // By vertex where the capture has indices of vertices or `vertex_of` is given, else
  // by
  // position.
  kAuto,
  kVertex,
  // Where the marker was seen first, to the nearest point of the cloth's initial state.
  kPosition,
};

struct AttachOptions {
  AttachMethod method = AttachMethod::kAuto;
  // The object that was captured; its vertices are then counted from 0. -1: all of
  // them, vertices counted through the objects, object 0 first.
  int object = -1;
  // Vertex of each marker, by name; see ReadMarkerMap.
  std::map<std::string, int> vertex_of;
  // m, the farthest a marker may be from the cloth when it is attached by position; 0:
  // half the mean length of the edges of the triangles it may be attached to.
  double max_distance = 0.0;
};

// Reads `marker,vertex` lines (CSV with that header).
// @throws SceneError naming file, line, value and what is accepted; also for a marker
//         or a vertex that is there twice
DPE_ESTIMATION_API std::map<std::string, int> ReadMarkerMap(const std::string& path);

// Attaches a capture in the scene's units (ToSceneUnits) to the cloths of a scene.
//
// Vertices that were seen at frames (to 1e-9 frames) are in `positions`; all else is in
// `markers` and `samples`, which are in the order of time. Markers attached by position
// have three vertices, the barycentric weights of the nearest point of the nearest
// triangle, and their distance from it.
//
// @param capture   times in frames, positions in m
// @param scene     whose initial state the markers are attached to
// @param options   how
// @param warnings  if not null, receives one line per thing that is worth a look: a
//                  marker that was not seen at the beginning, a vertex map entry that
//                  no marker has
// @throws SceneError naming the file, its line where there is one, value and what is
//         accepted: a vertex out of range, a number of vertices that is not the
//         scene's, a marker that the map does not have, one too far from the cloth, a
//         point given twice at one time
DPE_ESTIMATION_API Observations AttachCapture(
    const Capture& capture, const Scene& scene, const AttachOptions& options = {},
    std::vector<std::string>* warnings = nullptr);

}  // namespace dpe

#endif  // DPE_ESTIMATION_ATTACH_H_
