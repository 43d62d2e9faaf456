// A recorded motion and where in it the clock is.
//
//   time(now) = base + rate (now - start)  while it runs
//
// held between 0 and the duration: wrapped with a loop, else it halts at the end.
#ifndef DPE_UNITY_PLAYBACK_HANDLE_H_
#define DPE_UNITY_PLAYBACK_HANDLE_H_

#include <Eigen/Core>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <vector>

#include "call.h"
#include "dpe/c/playback.h"
#include "dpe/c/scene.h"
#include "dpe/engine/scene.h"
#include "handle_table.h"
#include "position_buffer.h"

namespace dpe::c {

class PlaybackHandle : public HandleObject {
 public:
  static constexpr HandleKind kKind = HandleKind::kPlayback;

  // @throws SceneError if the recording cannot be read or is not complete
  PlaybackHandle(const Scene& scene, const std::string& path);

  dpe_playback_info Info();
  void Start();
  void Pause();
  void Stop();
  void Seek(double time);
  void SetRate(double rate);
  void SetLoop(bool loop);
  // As PositionBuffer::Copy.
  void CopyPositions(int object, float* positions, int capacity,
                     std::uint64_t* sequence, std::int64_t* frame,
                     std::int32_t* is_new);

 private:
  using Clock = std::chrono::steady_clock;

  int num_frames() const { return num_frames_; }
  double duration() const { return (num_frames_ - 1) * frame_length_; }
  // Makes `base_` the time now. The caller holds the mutex.
  void Update();
  void GoTo(double time);

  double frame_length_;  // s
  int num_frames_ = 0;
  std::vector<Eigen::MatrixXd> recorded_;  // per object 3N x F, or x 1: it stands still
  std::mutex mutex_;                       // guards what follows
  double base_ = 0.0;
  Clock::time_point start_;
  double rate_ = 1.0;
  bool loop_ = false;
  int state_ = DPE_STOPPED;
  std::int64_t shown_ = -1;  // the frame that positions_ holds
  PositionBuffer positions_;
};

}  // namespace dpe::c

#endif  // DPE_UNITY_PLAYBACK_HANDLE_H_
