#include "captures/marker_places.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "captures/nearest_triangle.h"
#include "captures/text.h"

namespace dpe {
namespace {

class MarkerPlacer {
 public:
  MarkerPlacer(const Capture& capture, const Scene& scene, const AttachOptions& options,
               std::vector<std::string>* warnings)
      : capture_(capture), scene_(scene), options_(options), warnings_(warnings) {
    const int num_objects = static_cast<int>(scene.objects.size());
    if (options.object < -1 || options.object >= num_objects) {
      throw SceneError(capture.path + ": is to be of object " +
                       std::to_string(options.object) + "; accepted are 0 to " +
                       std::to_string(num_objects - 1));
    }
    for (int o = 0; o < num_objects; ++o) {
      if (options.object >= 0 && o != options.object) continue;
      objects_.push_back(o);
      for (int v = 0; v < scene.objects[o].num_vertices(); ++v) {
        owners_.emplace_back(o, v);
      }
    }
  }

  MarkerPlaces PlaceAll() {
    if (ByPosition()) {
      AttachByPosition();
    } else if (capture_.markers_are_vertices()) {
      AttachVertices();
    } else {
      AttachByName();
    }
    return {std::move(places_), std::move(markers_)};
  }

 private:
  [[noreturn]] void Fail(const CaptureSample& sample, const std::string& what) const {
    FailAtSample(capture_, sample, what);
  }

  std::string NameOf(int marker) const { return MarkerText(capture_, marker); }

  void Warn(const std::string& text) {
    if (warnings_ != nullptr) warnings_->push_back(capture_.path + ": " + text);
  }

  bool ByPosition() const {
    if (options_.method != AttachMethod::kAuto) {
      return options_.method == AttachMethod::kPosition;
    }
    return !capture_.markers_are_vertices() && options_.vertex_of.empty();
  }

  Place PlaceOfVertex(int vertex) const {
    return {true, owners_[vertex].first, owners_[vertex].second, -1};
  }

  // The capture's vertices that count: all, or those of a face, if that is as many as
  // the cloth has (a cloth built from the mesh leaves the others out).
  std::vector<int> CountedVertices() const {
    std::vector<int> counted(capture_.num_vertices);
    std::iota(counted.begin(), counted.end(), 0);
    if (counted.size() == owners_.size() || capture_.mesh.in_a_face.empty()) {
      return counted;
    }
    std::vector<int> in_a_face;
    for (int v : counted) {
      if (capture_.mesh.in_a_face[v]) in_a_face.push_back(v);
    }
    return in_a_face.size() == owners_.size() ? in_a_face : counted;
  }

  void AttachVertices() {
    const int num_owned = static_cast<int>(owners_.size());
    if (capture_.num_vertices > 0) {
      const std::vector<int> counted = CountedVertices();
      if (static_cast<int>(counted.size()) != num_owned) {
        throw SceneError(
            capture_.path + ": has " + std::to_string(capture_.num_vertices) +
            " vertices; accepted are the " + std::to_string(num_owned) + " of " +
            (options_.object >= 0
                 ? "object " + std::to_string(options_.object)
                 : "the scene, or those of one object if it is named"));
      }
      places_.resize(capture_.num_vertices);
      for (int i = 0; i < num_owned; ++i) places_[counted[i]] = PlaceOfVertex(i);
      return;
    }
    for (int v = 0; v < num_owned; ++v) places_.push_back(PlaceOfVertex(v));
    for (const CaptureSample& sample : capture_.samples) {
      if (sample.marker < num_owned) continue;
      Fail(sample, "vertex is '" + std::to_string(sample.marker) +
                       "'; accepted is an integer from 0 to " +
                       std::to_string(num_owned - 1));
    }
  }

  void AttachByName() {
    std::vector<char> known(capture_.marker_names.size(), 0);
    places_.resize(capture_.marker_names.size());
    for (size_t m = 0; m < places_.size(); ++m) {
      const auto found = options_.vertex_of.find(capture_.marker_names[m]);
      if (found == options_.vertex_of.end()) continue;
      if (found->second < 0 || found->second >= static_cast<int>(owners_.size())) {
        throw SceneError(capture_.path + ": marker " + found->first +
                         " is to be vertex " + std::to_string(found->second) +
                         "; accepted is 0 to " + std::to_string(owners_.size() - 1));
      }
      places_[m] = PlaceOfVertex(found->second);
      known[m] = 1;
    }
    for (const CaptureSample& sample : capture_.samples) {
      if (known[sample.marker]) continue;
      std::string accepted;
      for (const auto& entry : options_.vertex_of) {
        accepted += (accepted.empty() ? "" : ", ") + entry.first;
      }
      Fail(sample, "marker is '" + capture_.marker_names[sample.marker] +
                       "', of which nothing says where it is; accepted are " +
                       (accepted.empty() ? "those of a map of markers to vertices"
                                         : Excerpt(accepted)));
    }
    WarnOfUnseen();
  }

  void WarnOfUnseen() {
    for (const auto& entry : options_.vertex_of) {
      const auto& names = capture_.marker_names;
      if (std::find(names.begin(), names.end(), entry.first) == names.end()) {
        Warn("has no marker '" + entry.first + "', which is in the map of markers");
      }
    }
  }

  void AttachByPosition() {
    const size_t num_markers = capture_.markers_are_vertices()
                                   ? static_cast<size_t>(HighestMarker() + 1)
                                   : capture_.marker_names.size();
    std::vector<const CaptureSample*> first(num_markers, nullptr);
    for (const CaptureSample& sample : capture_.samples) {
      const CaptureSample*& own = first[sample.marker];
      if (own == nullptr || sample.time < own->time) own = &sample;
    }
    places_.resize(num_markers);
    for (size_t m = 0; m < num_markers; ++m) {
      if (first[m] != nullptr) AttachNearest(static_cast<int>(m), *first[m]);
    }
  }

  int HighestMarker() const {
    int highest = -1;
    for (const CaptureSample& s : capture_.samples) {
      highest = std::max(highest, s.marker);
    }
    return highest;
  }

  void AttachNearest(int m, const CaptureSample& sample) {
    NearestPoint nearest;
    nearest.distance = std::numeric_limits<double>::infinity();
    int object = -1;
    for (int o : objects_) {
      const NearestPoint found =
          FindNearestTriangle(sample.position, scene_.objects[o]);
      if (found.triangle < 0 || found.distance >= nearest.distance) continue;
      nearest = found;
      object = o;
    }
    if (object < 0)
      Fail(sample, NameOf(m) + ": there are no triangles to attach it to");
    const double limit = options_.max_distance > 0.0
                             ? options_.max_distance
                             : 0.5 * MeanEdgeLength(scene_.objects[object]);
    if (!(nearest.distance <= limit)) {
      Fail(sample, NameOf(m) + " is " + NumberField(nearest.distance) +
                       " m from the cloth where it is first seen, at frame " +
                       NumberField(sample.time) + "; accepted is at most " +
                       NumberField(limit) + " m" +
                       (options_.max_distance > 0.0
                            ? ""
                            : ", half the mean length of the triangles' edges"));
    }
    if (sample.time > kFrameTolerance) {
      Warn(NameOf(m) + " is first seen at frame " + NumberField(sample.time) +
           "; it was attached as if the cloth had not moved before that");
    }
    const auto& triangle = scene_.objects[object].triangles[nearest.triangle];
    Marker marker;
    marker.name = MarkerName(capture_, m);
    marker.object = object;
    marker.vertices.assign(triangle.begin(), triangle.end());
    marker.weights.assign(nearest.weights.data(), nearest.weights.data() + 3);
    marker.distance = nearest.distance;
    places_[m].object = object;
    places_[m].marker = static_cast<int>(markers_.size());
    markers_.push_back(marker);
  }

  const Capture& capture_;
  const Scene& scene_;
  const AttachOptions& options_;
  std::vector<std::string>* warnings_;
  std::vector<int> objects_;                 // that may be attached to
  std::vector<std::pair<int, int>> owners_;  // object, vertex in it, of each vertex
  std::vector<Place> places_;
  std::vector<Marker> markers_;
};

}  // namespace

MarkerPlaces PlaceMarkers(const Capture& capture, const Scene& scene,
                          const AttachOptions& options,
                          std::vector<std::string>* warnings) {
  return MarkerPlacer(capture, scene, options, warnings).PlaceAll();
}

std::string MarkerName(const Capture& capture, int marker) {
  return capture.markers_are_vertices() ? std::to_string(marker)
                                        : capture.marker_names[marker];
}

std::string MarkerText(const Capture& capture, int marker) {
  return (capture.markers_are_vertices() ? "vertex " : "marker ") +
         MarkerName(capture, marker);
}

void FailAtSample(const Capture& capture, const CaptureSample& sample,
                  const std::string& what) {
  if (sample.line > 0) FailAtLine(capture.path, sample.line, what);
  throw SceneError(capture.path + ": " + what);
}

}  // namespace dpe
