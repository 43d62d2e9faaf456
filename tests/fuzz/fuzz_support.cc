#include "fuzz/fuzz_support.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "dpe/engine/cloth_builder.h"
#include "dpe/estimation/attach.h"
#include "dpe/estimation/observations.h"

namespace dpe::test {

void FailFuzzing(const std::string& message) {
  std::fprintf(stderr, "%s\n", message.c_str());
  std::abort();
}

std::string TextOf(const std::uint8_t* bytes, std::size_t size) {
  return std::string(reinterpret_cast<const char*>(bytes), size);
}

MemoryFile::MemoryFile() : descriptor_(memfd_create("fuzz", 0)) {
  Require(descriptor_ >= 0, "no file in memory could be made");
  path_ = "/proc/self/fd/" + std::to_string(descriptor_);
}

MemoryFile::~MemoryFile() { close(descriptor_); }

void MemoryFile::Write(const std::string& content) {
  Require(ftruncate(descriptor_, 0) == 0, "the file in memory cannot be emptied");
  const ssize_t written = pwrite(descriptor_, content.data(), content.size(), 0);
  Require(written == static_cast<ssize_t>(content.size()),
          "the file in memory cannot be written");
}

const Scene& FuzzScene() {
  static const Scene scene = [] {
    PresetOptions options;
    options.rows = options.cols = 3;
    Scene two = MakePresetScene(ScenePreset::kSide, options);
    two.objects.push_back(two.objects[0]);
    return two;
  }();
  return scene;
}

namespace {

void CheckSamples(const Capture& capture) {
  Require(!capture.samples.empty(), "a capture without samples");
  const int limit = capture.markers_are_vertices()
                        ? capture.num_vertices
                        : static_cast<int>(capture.marker_names.size());
  for (const CaptureSample& sample : capture.samples) {
    Require(sample.marker >= 0, "a marker before the first");
    Require(limit == 0 || sample.marker < limit, "a marker after the last");
    Require(sample.position.allFinite(), "a position that is not finite");
    Require(std::isfinite(sample.time), "a time that is not finite");
    Require(std::isfinite(sample.sigma) && sample.sigma >= 0.0, "a wrong sigma");
  }
}

void CheckObservations(const Observations& observations) {
  const Scene& scene = FuzzScene();
  Require(observations.positions.size() == scene.objects.size(), "missing objects");
  for (std::size_t k = 0; k < scene.objects.size(); ++k) {
    const Eigen::MatrixXd& positions = observations.positions[k];
    Require(
        positions.size() == 0 || positions.rows() == scene.objects[k].positions.size(),
        "observations of another object");
    Require(!positions.array().isInf().any(), "an infinite position");
    observations.IsComplete(scene, static_cast<int>(k));
  }
  for (const MarkerSample& sample : observations.samples) {
    Require(sample.marker >= 0 &&
                sample.marker < static_cast<int>(observations.markers.size()),
            "a sample of no marker");
    Require(sample.time >= 0.0 && sample.time < observations.num_frames() + 1.0,
            "a sample at no time");
    Require(sample.position.allFinite(), "a sample that is not finite");
  }
}

}  // namespace

void CheckCapture(const Capture& capture, const CaptureOptions& options) {
  CheckSamples(capture);
  Capture converted = capture;
  if (!IsAccepted([&] { ToSceneUnits(options, FuzzScene().delta, &converted); })) {
    return;
  }
  CheckSamples(converted);
  for (const AttachMethod method : {AttachMethod::kAuto, AttachMethod::kPosition}) {
    for (const int object : {-1, 1}) {
      AttachOptions attach;
      attach.method = method;
      attach.object = object;
      attach.max_distance = 10.0;
      IsAccepted(
          [&] { CheckObservations(AttachCapture(converted, FuzzScene(), attach)); });
    }
  }
}

int FuzzCapture(const std::string& format, const std::uint8_t* bytes,
                std::size_t size) {
  static MemoryFile file;
  file.Write(TextOf(bytes, size));
  CaptureOptions tolerant;
  tolerant.nan_is_missing = true;
  tolerant.scale = 0.01;
  tolerant.up = UpAxis::kZ;
  tolerant.origin = TimeOrigin::kFirstSample;
  for (const CaptureOptions& options : {CaptureOptions(), tolerant}) {
    IsAccepted([&] {
      const Capture capture = ReadCapture(file.path(), options);
      if (capture.format == format) CheckCapture(capture, options);
    });
  }
  return 0;
}

}  // namespace dpe::test
