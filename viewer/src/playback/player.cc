#include "playback/player.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dpe::viewer {
namespace {

constexpr std::size_t kHistoryBytes = std::size_t{256} << 20;
// Errors of a live simulation without an end are noted up to here.
constexpr int kMaxErrors = 100000;

}  // namespace

Player::Player(PlayerSources sources)
    : sources_(std::move(sources)), history_(kHistoryBytes) {
  controls_.tuning = TuningOf(sources_.scene);
  std::vector<Scene> live;
  if (!sources_.trajectory) live.push_back(sources_.scene);
  if (sources_.compared) live.push_back(*sources_.compared);
  if (!live.empty()) {
    if (sources_.trajectory) controls_.tuning = TuningOf(live[0]);
    live_ = std::make_unique<LiveSource>(std::move(live), sources_.on_frame);
    live_->Update();
    TakeLiveFrame();
  } else if (sources_.target) {
    // Recordings are all there: so is the whole curve.
    for (int f = 0; f < sources_.trajectory->num_frames(); ++f) {
      NoteError(f, sources_.trajectory->At(f));
    }
  }
  Show(0);
}

const Scene* Player::compared() const {
  return sources_.compared ? &*sources_.compared : nullptr;
}

const RecordedMotion* Player::target() const {
  return sources_.target ? &*sources_.target : nullptr;
}

const MotionState* Player::compared_motion() const {
  return sources_.compared ? &compared_motion_ : nullptr;
}

const MotionState* Player::target_state() const {
  return sources_.target && sources_.target->shows_vertices() ? &target_state_
                                                              : nullptr;
}

int Player::first_frame() const { return live_ ? history_.first_frame() : 0; }

int Player::last_frame() const {
  if (live_) return history_.last_frame();
  const int target = sources_.target ? sources_.target->num_frames() : 0;
  return std::max(sources_.trajectory->num_frames(), target) - 1;
}

bool Player::Update(double now) {
  if (live_) {
    if (live_->Update()) TakeLiveFrame();
  } else if (AdvanceClock(now)) {
    Show(static_cast<int>(clock_ / sources_.scene.delta + 1e-9));
  }
  return std::exchange(changed_, false);
}

bool Player::AdvanceClock(double now) {
  const double elapsed = last_now_ < 0.0 ? 0.0 : now - last_now_;
  last_now_ = now;
  if (controls_.paused) return false;
  const double delta = sources_.scene.delta;
  clock_ += elapsed * controls_.speed;
  // Over and over again.
  if (clock_ >= (last_frame() + 1) * delta) clock_ = 0.0;
  return static_cast<int>(clock_ / delta + 1e-9) != frame_;
}

void Player::TakeLiveFrame() {
  const LiveFrame& news = live_->frame();
  changed_ = true;
  if (news.restarts != controls_.restarts) return;  // of before a restart
  if (std::exchange(restarts_seen_, news.restarts) != news.restarts) history_.Clear();
  // A failure comes with the frame that was there before.
  if (!history_.empty() && news.frame == history_.last_frame()) return;
  history_.Add({news.frame, news.motions});
  if (!sources_.trajectory) NoteError(news.frame, news.motions[0]);
  if (follow_) Show(news.frame);
}

void Player::NoteError(int frame, const MotionState& motion) {
  if (!sources_.target || frame >= kMaxErrors) return;
  if (static_cast<int>(errors_.size()) <= frame) {
    errors_.resize(frame + 1, std::numeric_limits<float>::quiet_NaN());
  }
  errors_[frame] = static_cast<float>(RmsDistance(*sources_.target, frame, motion));
}

void Player::Show(int frame) {
  changed_ = true;
  if (live_) {
    const Moment& moment = history_.At(frame);
    frame_ = moment.frame;
    if (!sources_.trajectory) motion_ = moment.motions[0];
    if (sources_.compared) compared_motion_ = moment.motions.back();
  } else {
    frame_ = std::clamp(frame, 0, last_frame());
  }
  if (sources_.trajectory) {
    motion_ = sources_.trajectory->At(frame_);
    if (live_) NoteError(frame_, motion_);
  }
  if (target_state() != nullptr) target_state_ = sources_.target->At(frame_);
}

void Player::SetPaused(bool paused) {
  controls_.paused = paused;
  changed_ = true;
  if (!live_) return;
  if (!paused && !follow_) Seek(last_frame());
  live_->Set(controls_);
}

void Player::Restart() {
  clock_ = 0.0;
  if (!live_) {
    Show(0);
    return;
  }
  ++controls_.restarts;
  follow_ = true;
  errors_.clear();
  live_->Set(controls_);
}

void Player::StepForward() {
  if (!controls_.paused) SetPaused(true);
  if (!live_) {
    Seek(frame_ + 1);
    return;
  }
  if (frame_ < last_frame()) {
    Seek(history_.After(frame_).frame);
    return;
  }
  follow_ = true;
  ++controls_.steps;
  live_->Set(controls_);
}

void Player::StepBack() {
  if (!controls_.paused) SetPaused(true);
  Seek(frame_ - 1);
}

void Player::Seek(int frame) {
  frame = std::clamp(frame, first_frame(), last_frame());
  clock_ = frame * sources_.scene.delta;
  if (live_) {
    follow_ = frame == last_frame();
    if (!follow_ && !controls_.paused) SetPaused(true);
  }
  Show(frame);
}

bool Player::IsWaiting() const {
  if (!live_) return false;
  const LiveFrame& news = live_->frame();
  return news.restarts != controls_.restarts || news.steps < controls_.steps;
}

void Player::SetSpeed(double speed) {
  controls_.speed = speed;
  changed_ = true;
  if (live_) live_->Set(controls_);
}

void Player::SetTuning(const Tuning& tuning) {
  controls_.tuning = tuning;
  changed_ = true;
  if (live_) live_->Set(controls_);
}

}  // namespace dpe::viewer
