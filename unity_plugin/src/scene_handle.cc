#include "scene_handle.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dpe::c {

SceneHandle::SceneHandle(const Scene& scene, std::string warnings)
    : warnings_(std::move(warnings)), model_(scene, &interrupted_), positions_(scene) {
  Publish();
}

SceneHandle::~SceneHandle() { Close(); }

void SceneHandle::Close() {
  closing_ = true;
  interrupted_ = true;
  std::thread thread;
  {
    const Access access(this);
    thread.swap(thread_);
  }
  if (thread.joinable()) thread.join();
}

void SceneHandle::RequireOpen() const {
  if (closing_) throw ApiError(DPE_ERROR_STATE, "the scene is being destroyed");
}

void SceneHandle::Publish() {
  for (int o = 0; o < positions_.num_objects(); ++o) {
    positions_.Write(o, model_.positions(o).data());
  }
  positions_.Publish(model_.frame());
}

bool SceneHandle::Advance() {
  const RolloutStatus status = model_.Advance();
  if (status.ok()) {
    Publish();
    return true;
  }
  // Given up for a stop, which is about to set the state, or for good.
  if (status.code == RolloutStatus::Code::kInterrupted) {
    state_ = DPE_PAUSED;
  } else {
    state_ = DPE_FAILED;
    set_last_error(status.Message());
  }
  return false;
}

dpe_scene_info SceneHandle::Info() {
  const Access access(this);
  dpe_scene_info info{};
  const Scene& scene = model_.now();
  info.num_objects = static_cast<int32_t>(scene.objects.size());
  info.num_colliders = static_cast<int32_t>(scene.colliders.size());
  info.num_frames = scene.num_frames;
  info.steps_per_frame = scene.steps_per_frame;
  info.frame_length = scene.delta;
  info.state = state_;
  info.frame = model_.frame();
  return info;
}

void SceneHandle::Step(int num_frames) {
  Require(num_frames >= 0, "the number of frames is negative");
  std::uint64_t stops = 0;
  for (int f = 0; f < num_frames; ++f) {
    const Access access(this);
    RequireOpen();
    if (f == 0) stops = stops_;
    if (state_ == DPE_RUNNING) {
      throw ApiError(DPE_ERROR_STATE, "the scene's thread is running; pause it first");
    }
    if (stops != stops_) throw ApiError(DPE_ERROR_STATE, "the scene was stopped");
    state_ = DPE_PAUSED;
    if (Advance()) continue;
    if (state_ == DPE_FAILED) throw ApiError(DPE_ERROR_SIMULATION, last_error());
    throw ApiError(DPE_ERROR_STATE, "the scene was stopped");
  }
}

SceneHandle::Clock::duration SceneHandle::FrameTime() const {
  constexpr double kLongest = 3600.0;  // s; what a clock's duration can surely hold
  if (rate_ == 0.0) return {};
  return std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double>(std::min(model_.now().delta / rate_, kLongest)));
}

void SceneHandle::Start() {
  const Access access(this);
  RequireOpen();
  if (state_ == DPE_RUNNING) return;
  if (!thread_.joinable()) thread_ = std::thread([this] { Run(); });
  due_ = Clock::now() + FrameTime();
  state_ = DPE_RUNNING;
}

void SceneHandle::Pause() {
  const Access access(this);
  if (state_ == DPE_RUNNING) state_ = DPE_PAUSED;
}

void SceneHandle::Stop() {
  interrupted_ = true;
  const Access access(this);
  // While the object closes, frames stay interrupted.
  interrupted_ = closing_.load();
  ++stops_;
  state_ = DPE_STOPPED;
  model_.Restart();
  Publish();
}

void SceneHandle::SetRate(double rate) {
  Require(std::isfinite(rate) && rate >= 0.0,
          "the rate; accepted is a finite number that is not negative");
  const Access access(this);
  rate_ = rate;
  due_ = Clock::now() + FrameTime();
}

void SceneHandle::Run() {
  constexpr auto kMostBehind = std::chrono::milliseconds(250);
  std::unique_lock<FairMutex> lock(mutex_);
  while (!closing_) {
    if (state_ != DPE_RUNNING) {
      wake_.wait(lock);
      continue;
    }
    // A copy: it is read while the mutex is not held, and the rate may be changed then.
    const Clock::time_point due = due_;
    if (Clock::now() < due) {
      wake_.wait_until(lock, due);
      continue;
    }
    Advance();
    // Frames are due at equal distances, not so long after the one before.
    due_ += FrameTime();
    const auto now = Clock::now();
    if (rate_ == 0.0 || now - due_ > kMostBehind) due_ = now;
    // Those who have waited go first.
    lock.unlock();
    lock.lock();
  }
}

}  // namespace dpe::c
