#include <algorithm>
#include <cmath>
#include <string>

#include "captures/marker_places.h"
#include "captures/text.h"
#include "dpe/engine/scene.h"
#include "dpe/estimation/capture.h"

namespace dpe {
namespace {

void RequireNotNegative(const Capture& capture, const char* what, double value) {
  if (std::isfinite(value) && value >= 0.0) return;
  throw SceneError(
      capture.path + ": the " + what + " " + NumberField(value) +
      " is not accepted; expected a finite number > 0, or 0 for the default");
}

// m per unit of the file.
double ScaleOf(const CaptureOptions& options, const Capture& capture) {
  RequireNotNegative(capture, "scale", options.scale);
  if (options.scale > 0.0) return options.scale;
  const std::string& unit = capture.length_unit;
  if (unit.empty() || unit == "m" || unit == "meters") return 1.0;
  if (unit == "mm" || unit == "millimeters") return 1e-3;
  if (unit == "cm" || unit == "centimeters") return 1e-2;
  throw SceneError(capture.path + ": Units is '" + unit +
                   "'; accepted are m, cm and mm, or a scale (m per unit of the file)");
}

// Scene frames per unit of time of the file.
double FramesPerUnit(const CaptureOptions& options, double frame_length,
                     const Capture& capture) {
  RequireNotNegative(capture, "rate", options.rate);
  if (capture.time_unit == Capture::TimeUnit::kFrames) {
    return options.rate > 0.0 ? 1.0 / (options.rate * frame_length) : 1.0;
  }
  if (options.rate > 0.0) {
    throw SceneError(capture.path +
                     ": has times of its own; a rate is accepted for formats that "
                     "number frames only");
  }
  return 1.0 / frame_length;
}

double FirstTime(const Capture& capture) {
  double first = capture.samples.empty() ? 0.0 : capture.samples[0].time;
  for (const CaptureSample& s : capture.samples) first = std::min(first, s.time);
  return first;
}

}  // namespace

void ToSceneUnits(const CaptureOptions& options, double frame_length,
                  Capture* capture) {
  const double scale = ScaleOf(options, *capture);
  const double frames_per_unit = FramesPerUnit(options, frame_length, *capture);
  const bool from_first =
      options.origin == TimeOrigin::kFirstSample ||
      (options.origin == TimeOrigin::kAuto && !capture->frame_zero_is_initial);
  const double origin = from_first ? FirstTime(*capture) : 0.0;
  for (CaptureSample& sample : capture->samples) {
    if (sample.time < origin) {
      FailAtSample(*capture, sample,
                   "the time is " + NumberField(sample.time) +
                       "; accepted are times from 0, the initial state");
    }
    sample.time = (sample.time - origin) * frames_per_unit;
    const Eigen::Vector3d p = scale * sample.position;
    sample.position =
        options.up == UpAxis::kZ ? Eigen::Vector3d(p.x(), p.z(), -p.y()) : p;
    sample.sigma *= scale;
  }
}

}  // namespace dpe
