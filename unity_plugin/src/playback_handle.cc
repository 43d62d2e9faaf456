#include "playback_handle.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "dpe/estimation/load_target.h"

namespace dpe::c {
namespace {

// Every vertex of the objects that it shows, at every frame.
std::vector<Eigen::MatrixXd> ReadRecording(Scene scene, const std::string& path,
                                           int* num_frames) {
  Observations seen = LoadTarget(path, {}, &scene);
  if (!seen.samples.empty()) {
    throw SceneError(path +
                     ": it has points between vertices or frames; accepted for "
                     "playback are positions of vertices at frames");
  }
  seen.positions.resize(scene.objects.size());
  *num_frames = std::max(1, seen.num_frames());
  for (std::size_t o = 0; o < scene.objects.size(); ++o) {
    Eigen::MatrixXd& positions = seen.positions[o];
    if (seen.positions[o].size() == 0 || seen.NumObserved(static_cast<int>(o)) == 0) {
      positions = scene.objects[o].positions;
      continue;
    }
    if (positions.cols() < *num_frames) {
      throw SceneError(path + ": object " + std::to_string(o) +
                       " ends before the others; accepted are recordings of all "
                       "objects over all frames");
    }
    for (int f = 0; f < *num_frames; ++f) {
      for (int i = 0; i < scene.objects[o].num_vertices(); ++i) {
        if (positions.col(f).segment<3>(3 * i).allFinite()) continue;
        throw SceneError(path + ": vertex " + std::to_string(i) + " of object " +
                         std::to_string(o) + " is missing at frame " +
                         std::to_string(f) +
                         "; accepted for playback are recordings without gaps");
      }
    }
  }
  return std::move(seen.positions);
}

}  // namespace

PlaybackHandle::PlaybackHandle(const Scene& scene, const std::string& path)
    : frame_length_(scene.delta),
      recorded_(ReadRecording(scene, path, &num_frames_)),
      positions_(scene) {}

void PlaybackHandle::Update() {
  if (state_ != DPE_RUNNING) return;
  const auto now = Clock::now();
  const double end = duration();
  double time = base_ + rate_ * std::chrono::duration<double>(now - start_).count();
  if (time < 0.0 || time > end) {
    if (loop_ && end > 0.0) {
      // The last frame is shown for as long as the others.
      const double period = end + frame_length_;
      time -= period * std::floor(time / period);
      if (!std::isfinite(time)) time = 0.0;
    } else {
      time = std::min(std::max(time, 0.0), end);
      state_ = DPE_PAUSED;
    }
  }
  base_ = time;
  start_ = now;
}

void PlaybackHandle::GoTo(double time) {
  base_ = std::min(std::max(time, 0.0), duration());
  start_ = Clock::now();
}

dpe_playback_info PlaybackHandle::Info() {
  const std::lock_guard<std::mutex> lock(mutex_);
  Update();
  dpe_playback_info info{};
  info.num_objects = static_cast<int32_t>(recorded_.size());
  info.num_frames = num_frames_;
  info.frame_length = frame_length_;
  info.duration = duration();
  info.time = base_;
  info.rate = rate_;
  info.state = state_;
  info.loop = loop_ ? 1 : 0;
  return info;
}

void PlaybackHandle::Start() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (state_ == DPE_RUNNING) return;
  if (!loop_ && rate_ > 0.0 && base_ >= duration()) base_ = 0.0;
  if (!loop_ && rate_ < 0.0 && base_ <= 0.0) base_ = duration();
  start_ = Clock::now();
  state_ = DPE_RUNNING;
}

void PlaybackHandle::Pause() {
  const std::lock_guard<std::mutex> lock(mutex_);
  Update();
  if (state_ == DPE_RUNNING) state_ = DPE_PAUSED;
}

void PlaybackHandle::Stop() {
  const std::lock_guard<std::mutex> lock(mutex_);
  GoTo(0.0);
  state_ = DPE_STOPPED;
}

void PlaybackHandle::Seek(double time) {
  RequireFinite("time", &time, 1);
  const std::lock_guard<std::mutex> lock(mutex_);
  GoTo(time);
  if (state_ == DPE_STOPPED) state_ = DPE_PAUSED;
}

void PlaybackHandle::SetRate(double rate) {
  RequireFinite("rate", &rate, 1);
  const std::lock_guard<std::mutex> lock(mutex_);
  Update();
  rate_ = rate;
}

void PlaybackHandle::SetLoop(bool loop) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Update();
  loop_ = loop;
}

void PlaybackHandle::CopyPositions(int object, float* positions, int capacity,
                                   std::uint64_t* sequence, std::int64_t* frame,
                                   std::int32_t* is_new) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Update();
  // Times that were meant to be a frame may be less by rounding.
  const double frames = base_ / frame_length_ + 1e-6;
  const std::int64_t now =
      std::min<std::int64_t>(static_cast<std::int64_t>(frames), num_frames_ - 1);
  if (now != shown_) {
    for (int o = 0; o < positions_.num_objects(); ++o) {
      const Eigen::MatrixXd& recorded = recorded_[o];
      positions_.Write(o,
                       recorded.col(std::min<long>(now, recorded.cols() - 1)).data());
    }
    positions_.Publish(now);
    shown_ = now;
  }
  c::CopyPositions(positions_, object, positions, capacity, sequence, frame, is_new);
}

}  // namespace dpe::c
