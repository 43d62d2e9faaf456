#include "dpe/estimation/observed_scene.h"

#include <algorithm>
#include <map>

namespace dpe {
namespace {

// Position by time, in frames.
using Track = std::map<double, Eigen::Vector3d>;

// The vertex that a marker is attached to alone; -1: it is a combination of several.
int OnlyVertex(const Marker& marker) {
  for (size_t k = 0; k < marker.vertices.size(); ++k) {
    if (marker.weights[k] == 1.0) return marker.vertices[k];
  }
  return -1;
}

bool IsObservedObject(const Observations& observations, int object) {
  if (observations.NumObserved(object) > 0) return true;
  return std::any_of(observations.markers.begin(), observations.markers.end(),
                     [object](const Marker& m) { return m.object == object; });
}

// What was seen of the fixed vertices of one object, by vertex.
std::map<int, Track> TracksOfPins(const Observations& observations, int object,
                                  const ClothObject& cloth) {
  std::map<int, Track> tracks;
  for (size_t i = 0; i < observations.samples.size(); ++i) {
    const MarkerSample& sample = observations.samples[i];
    const Marker& marker = observations.markers[sample.marker];
    const int vertex = marker.object == object ? OnlyVertex(marker) : -1;
    if (vertex < 0 || !cloth.is_fixed[vertex]) continue;
    tracks[vertex][sample.time] = sample.position;
  }
  if (observations.NumObserved(object) == 0) return tracks;
  const Eigen::MatrixXd& positions = observations.positions[object];
  for (int v = 0; v < cloth.num_vertices(); ++v) {
    if (!cloth.is_fixed[v]) continue;
    for (int f = 0; f < positions.cols(); ++f) {
      if (observations.IsObserved(object, v, f)) {
        tracks[v][f] = positions.col(f).segment<3>(3 * v);
      }
    }
  }
  return tracks;
}

Eigen::Vector3d At(const Track& track, double time) {
  const auto after = track.lower_bound(time);
  if (after == track.end()) return track.rbegin()->second;
  if (after == track.begin() || after->first == time) return after->second;
  const auto before = std::prev(after);
  const double t = (time - before->first) / (after->first - before->first);
  return before->second + t * (after->second - before->second);
}

PrescribedPath PathOf(int vertex, const Track& track, int num_frames) {
  PrescribedPath path;
  path.vertex = vertex;
  path.positions.resize(3, num_frames);
  for (int f = 0; f < num_frames; ++f) path.positions.col(f) = At(track, f);
  return path;
}

void SetPath(const PrescribedPath& path, ClothObject* cloth) {
  for (PrescribedPath& old : cloth->prescribed_paths) {
    if (old.vertex != path.vertex) continue;
    old = path;
    return;
  }
  cloth->prescribed_paths.push_back(path);
}

bool HasPath(const ClothObject& cloth, int vertex) {
  return std::any_of(cloth.prescribed_paths.begin(), cloth.prescribed_paths.end(),
                     [vertex](const PrescribedPath& p) { return p.vertex == vertex; });
}

}  // namespace

int FollowObservedPins(const Observations& observations, const std::string& name,
                       Scene* scene) {
  int count = 0;
  for (int o = 0; o < static_cast<int>(scene->objects.size()); ++o) {
    if (!IsObservedObject(observations, o)) continue;
    ClothObject& cloth = scene->objects[o];
    const std::map<int, Track> tracks = TracksOfPins(observations, o, cloth);
    // Positions are about to change; rest lengths that follow from them must not.
    if (!tracks.empty()) cloth.rest_length = RestLengths(cloth);
    for (int v = 0; v < cloth.num_vertices(); ++v) {
      if (!cloth.is_fixed[v]) continue;
      const auto track = tracks.find(v);
      if (track == tracks.end()) {
        if (HasPath(cloth, v)) continue;
        throw SceneError(name + ": vertex " + std::to_string(v) + " of object " +
                         std::to_string(o) +
                         " is fixed and is to follow the observation, but is never "
                         "observed; accepted are observations of the vertex itself, "
                         "a marker attached to it alone, or a path in the scene");
      }
      const PrescribedPath path = PathOf(v, track->second, observations.num_frames());
      cloth.positions.segment<3>(3 * v) = path.positions.col(0);
      SetPath(path, &cloth);
      ++count;
    }
  }
  return count;
}

int StartFromObservation(const Observations& observations, Scene* scene) {
  int count = 0;
  for (int o = 0; o < static_cast<int>(scene->objects.size()); ++o) {
    ClothObject& cloth = scene->objects[o];
    const Eigen::VectorXd rest_length = RestLengths(cloth);
    const int count_before = count;
    for (int v = 0; v < cloth.num_vertices(); ++v) {
      if (!observations.IsObserved(o, v, 0)) continue;
      cloth.positions.segment<3>(3 * v) =
          observations.positions[o].col(0).segment<3>(3 * v);
      ++count;
    }
    if (count > count_before) cloth.rest_length = rest_length;
  }
  return count;
}

}  // namespace dpe
