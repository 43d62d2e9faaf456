// Where on the cloth the markers of a capture are.
#ifndef DPE_ESTIMATION_SRC_CAPTURES_MARKER_PLACES_H_
#define DPE_ESTIMATION_SRC_CAPTURES_MARKER_PLACES_H_

#include <string>
#include <vector>

#include "dpe/estimation/attach.h"

namespace dpe {

// A time this close to a frame, in frames, is that frame: times are products and
// quotients of decimal numbers.
constexpr double kFrameTolerance = 1e-9;

// What a marker of the capture is on the cloth.
struct Place {
  bool is_vertex = false;
  int object = -1;  // -1: nothing: it was never seen, or the cloth does not have it
  int vertex = -1;
  int marker = -1;  // index into MarkerPlaces::markers; -1: none
};

struct MarkerPlaces {
  std::vector<Place> places;    // one per marker of the capture
  std::vector<Marker> markers;  // those that were attached by position
};

// @throws SceneError as AttachCapture
MarkerPlaces PlaceMarkers(const Capture& capture, const Scene& scene,
                          const AttachOptions& options,
                          std::vector<std::string>* warnings);

// "vertex 3" or "marker A".
std::string MarkerText(const Capture& capture, int marker);

// "FILE:LINE: what", or without the line if the sample has none, as a SceneError.
[[noreturn]] void FailAtSample(const Capture& capture, const CaptureSample& sample,
                               const std::string& what);

}  // namespace dpe

#endif  // DPE_ESTIMATION_SRC_CAPTURES_MARKER_PLACES_H_
