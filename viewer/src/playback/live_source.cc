#include "playback/live_source.h"

#include <algorithm>
#include <utility>

namespace dpe::viewer {
namespace {

// The notifier takes no lock, so a call can come just before the sleep: the longest
// that such a one goes unnoticed.
constexpr std::chrono::milliseconds kLongestSleep{50};
// Weight of the newest measurement in the smoothed ones.
constexpr double kNewest = 0.1;

double Milliseconds(std::chrono::steady_clock::duration time) {
  return std::chrono::duration<double, std::milli>(time).count();
}

double Smooth(double smoothed, double newest) {
  return smoothed == 0.0 ? newest : smoothed + kNewest * (newest - smoothed);
}

}  // namespace

LiveSource::LiveSource(std::vector<Scene> scenes, std::function<void()> on_frame)
    : scenes_(std::move(scenes)), on_frame_(std::move(on_frame)) {
  for (const Scene& scene : scenes_) {
    simulations_.push_back(std::make_unique<LiveSimulation>(scene));
  }
  controls_.tuning = TuningOf(scenes_[0]);
  Publish();
  thread_ = std::thread([this] { Run(); });
}

LiveSource::~LiveSource() {
  stop_ = true;
  has_news_ = true;
  wake_up_.notify_one();
  thread_.join();
}

void LiveSource::Set(const LiveControls& controls) {
  inbox_.back() = controls;
  inbox_.Publish();
  has_news_ = true;
  wake_up_.notify_one();
}

void LiveSource::TakeControls() {
  const LiveControls& news = inbox_.front();
  if (!(news.tuning == controls_.tuning)) {
    ApplyTuning(scenes_[0], controls_.tuning, news.tuning, simulations_[0].get());
    failure_.clear();
  }
  const bool restart = news.restarts != controls_.restarts;
  controls_ = news;
  if (!restart) return;
  for (const auto& simulation : simulations_) simulation->Restart();
  failure_.clear();
  was_running_ = false;
  Publish();
}

void LiveSource::Run() {
  while (!stop_) {
    has_news_ = false;
    if (inbox_.Update()) TakeControls();
    if (steps_done_ < controls_.steps) {
      if (failure_.empty()) Advance();
      ++steps_done_;
      Publish();
      continue;
    }
    const Clock::time_point now = Clock::now();
    if (controls_.paused || !failure_.empty()) {
      was_running_ = false;
      Wait(now + kLongestSleep);
      continue;
    }
    if (!was_running_) due_ = now;
    if (now < due_) {
      Wait(due_);
      continue;
    }
    const double length = scenes_[0].delta / std::max(controls_.speed, 1e-3);
    if (was_running_) {
      const double elapsed = 1e-3 * Milliseconds(now - last_begin_);
      turn_seconds_ = Smooth(turn_seconds_, elapsed);
    }
    last_begin_ = now;
    was_running_ = true;
    Advance();
    Publish();
    // What is late stays late, but for a moment's delay: a heavy scene would never
    // catch up.
    due_ += std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<double>(length));
    due_ = std::max(due_, Clock::now() - kLongestSleep);
  }
}

bool LiveSource::Advance() {
  const Clock::time_point begin = Clock::now();
  for (size_t s = 0; s < simulations_.size(); ++s) {
    const RolloutStatus status = simulations_[s]->AdvanceFrame();
    if (status.ok()) continue;
    failure_ = status.Message();
    return false;
  }
  frame_ms_ = Smooth(frame_ms_, Milliseconds(Clock::now() - begin));
  return true;
}

void LiveSource::Publish() {
  LiveFrame& frame = frames_.back();
  frame.frame = simulations_[0]->frame();
  frame.restarts = controls_.restarts;
  frame.steps = steps_done_;
  frame.frame_ms = frame_ms_;
  frame.rate = turn_seconds_ > 0.0 ? scenes_[0].delta / turn_seconds_ : 0.0;
  frame.failure = failure_;
  frame.motions.resize(simulations_.size());
  for (size_t s = 0; s < simulations_.size(); ++s) {
    MotionState& motion = frame.motions[s];
    const int num_objects = simulations_[s]->num_objects();
    motion.positions.resize(num_objects);
    motion.velocities.resize(num_objects);
    for (int o = 0; o < num_objects; ++o) {
      motion.positions[o] = simulations_[s]->positions(o);
      motion.velocities[o] = simulations_[s]->velocities(o);
    }
  }
  frames_.Publish();
  if (on_frame_) on_frame_();
}

void LiveSource::Wait(Clock::time_point until) {
  std::unique_lock<std::mutex> lock(mutex_);
  wake_up_.wait_until(lock, std::min(until, Clock::now() + kLongestSleep),
                      [this] { return has_news_.load(); });
}

}  // namespace dpe::viewer
