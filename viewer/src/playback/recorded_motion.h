// A motion that was recorded: seen by a camera, or simulated before.
#ifndef DPE_VIEWER_PLAYBACK_RECORDED_MOTION_H_
#define DPE_VIEWER_PLAYBACK_RECORDED_MOTION_H_

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "dpe/engine/scene.h"
#include "dpe/estimation/load_target.h"
#include "dpe/estimation/observations.h"
#include "playback/motion_state.h"

namespace dpe::viewer {

// A point of the cloth that was seen at a moment.
struct SeenMarker {
  const Marker* marker = nullptr;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // m
};

class RecordedMotion {
 public:
  RecordedMotion() = default;
  // @param delta  s, length of a frame
  RecordedMotion(Observations observations, double delta)
      : observations_(std::move(observations)), delta_(delta) {}

  int num_frames() const { return observations_.num_frames(); }
  const Observations& observations() const { return observations_; }
  // True if vertices were seen, and not only markers between them.
  bool shows_vertices() const;

  // The state at a frame; the last one after the end. Velocities are differences over
  // the neighbouring frames, where both were seen.
  MotionState At(int frame) const;

  // The markers seen within half a frame of a frame.
  std::vector<SeenMarker> MarkersAt(int frame) const;

 private:
  Observations observations_;
  double delta_ = 1.0;
};

// Reads a recording in any format that ReadCapture knows; see LoadTarget.
RecordedMotion LoadRecordedMotion(const std::string& path, const TargetOptions& options,
                                  Scene* scene, std::vector<std::string>* warnings);

// The root mean square of the distances of a state from what was seen at a frame, over
// vertices and markers, m; NaN if nothing was.
double RmsDistance(const RecordedMotion& target, int frame, const MotionState& state);

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_PLAYBACK_RECORDED_MOTION_H_
