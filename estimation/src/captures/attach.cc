#include "dpe/estimation/attach.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "captures/marker_places.h"
#include "captures/text.h"

namespace dpe {
namespace {

class Attacher {
 public:
  Attacher(const Capture& capture, const Scene& scene, MarkerPlaces places)
      : capture_(capture), scene_(scene), places_(std::move(places.places)) {
    observations_.positions.resize(scene.objects.size());
    observations_.markers = std::move(places.markers);
  }

  Observations Attach() {
    SplitSamples();
    FillPositions();
    AppendSamples();
    return std::move(observations_);
  }

 private:
  [[noreturn]] void Fail(const CaptureSample& sample, const std::string& what) const {
    FailAtSample(capture_, sample, what);
  }

  std::string NameOf(int marker) const { return MarkerText(capture_, marker); }

  // Which samples are vertices at frames, and which are markers' samples; drops those
  // of vertices that the cloth does not have.
  void SplitSamples() {
    double last_frame = 0.0;
    for (int i = 0; i < static_cast<int>(capture_.samples.size()); ++i) {
      const CaptureSample& sample = capture_.samples[i];
      const Place& place = places_[sample.marker];
      if (place.object < 0) continue;
      const double frame = std::round(sample.time);
      if (sample.time > kMaxFrame) {
        Fail(sample, "is at frame " + NumberField(sample.time) + "; accepted is 0 to " +
                         std::to_string(kMaxFrame));
      }
      last_frame = std::max(last_frame, frame);
      if (place.is_vertex && std::abs(sample.time - frame) <= kFrameTolerance) {
        at_frames_.push_back(i);
        num_frames_ = std::max(num_frames_, static_cast<int>(frame) + 1);
      } else {
        between_.push_back(i);
      }
    }
    // More than this per sample is a typing error in a frame number.
    if (last_frame > 1000.0 * static_cast<double>(capture_.samples.size()) + 1000.0) {
      throw SceneError(capture_.path + ": the last frame is " +
                       std::to_string(static_cast<long>(last_frame)) +
                       " but there are only " +
                       std::to_string(capture_.samples.size()) + " rows");
    }
  }

  void FillPositions() {
    std::vector<std::vector<int>> seen(scene_.objects.size());  // sample + 1
    for (int i : at_frames_) {
      const CaptureSample& sample = capture_.samples[i];
      const Place& place = places_[sample.marker];
      const int frame = static_cast<int>(std::round(sample.time));
      const int vertices = scene_.objects[place.object].num_vertices();
      Eigen::MatrixXd& positions = observations_.positions[place.object];
      std::vector<int>& seen_here = seen[place.object];
      if (positions.size() == 0) {
        positions = Eigen::MatrixXd::Constant(3 * vertices, num_frames_,
                                              std::numeric_limits<double>::quiet_NaN());
        seen_here.assign(static_cast<size_t>(vertices) * num_frames_, 0);
      }
      int& earlier = seen_here[static_cast<size_t>(frame) * vertices + place.vertex];
      if (earlier > 0) FailTwice(sample, capture_.samples[earlier - 1], frame);
      earlier = i + 1;
      positions.col(frame).segment<3>(3 * place.vertex) = sample.position;
      if (sample.sigma > 0.0) SetSigma(place, frame, sample.sigma);
    }
  }

  void SetSigma(const Place& place, int frame, double sigma) {
    observations_.sigmas.resize(scene_.objects.size());
    Eigen::MatrixXd& sigmas = observations_.sigmas[place.object];
    if (sigmas.size() == 0) {
      sigmas = Eigen::MatrixXd::Constant(scene_.objects[place.object].num_vertices(),
                                         num_frames_,
                                         std::numeric_limits<double>::quiet_NaN());
    }
    sigmas(place.vertex, frame) = sigma;
  }

  [[noreturn]] void FailTwice(const CaptureSample& sample, const CaptureSample& earlier,
                              double frame) const {
    Fail(sample,
         "frame " + NumberField(frame) + ", " + NameOf(sample.marker) +
             " was given before" +
             (earlier.marker == sample.marker ? "" : " as " + NameOf(earlier.marker)) +
             ", in line " + std::to_string(earlier.line));
  }

  void AppendSamples() {
    const auto key = [this](int i) {
      const CaptureSample& s = capture_.samples[i];
      return std::make_pair(s.time, s.marker);
    };
    std::stable_sort(between_.begin(), between_.end(),
                     [&key](int a, int b) { return key(a) < key(b); });
    for (size_t k = 0; k < between_.size(); ++k) {
      const CaptureSample& sample = capture_.samples[between_[k]];
      if (k > 0 && key(between_[k]) == key(between_[k - 1])) {
        FailTwice(sample, capture_.samples[between_[k - 1]], sample.time);
      }
      Place& place = places_[sample.marker];
      if (place.marker < 0) place.marker = AddVertexMarker(sample.marker, place);
      observations_.samples.push_back(
          {place.marker, sample.time, sample.position, sample.sigma});
    }
  }

  int AddVertexMarker(int m, const Place& place) {
    Marker marker;
    marker.name = MarkerName(capture_, m);
    marker.object = place.object;
    marker.vertices = {place.vertex};
    marker.weights = {1.0};
    observations_.markers.push_back(marker);
    return static_cast<int>(observations_.markers.size()) - 1;
  }

  const Capture& capture_;
  const Scene& scene_;
  std::vector<Place> places_;             // of each marker of the capture
  std::vector<int> at_frames_, between_;  // indices of samples
  int num_frames_ = 0;
  Observations observations_;
};

}  // namespace

Observations AttachCapture(const Capture& capture, const Scene& scene,
                           const AttachOptions& options,
                           std::vector<std::string>* warnings) {
  if (!std::isfinite(options.max_distance) || options.max_distance < 0.0) {
    throw SceneError(capture.path + ": the largest distance of a marker is " +
                     NumberField(options.max_distance) +
                     "; accepted is a finite number > 0 (m), or 0 for the default");
  }
  return Attacher(capture, scene, PlaceMarkers(capture, scene, options, warnings))
      .Attach();
}

}  // namespace dpe
