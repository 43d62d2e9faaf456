// When to give up: the clock and the user's interruption, polled from everywhere.
#ifndef DPE_ESTIMATION_STOP_CONTROL_H_
#define DPE_ESTIMATION_STOP_CONTROL_H_

#include <atomic>
#include <chrono>
#include <functional>
#include <utility>

namespace dpe {

class StopControl {
 public:
  // @param seconds_before  spent on the same fit by an earlier process; counts in
  //                        Seconds(), but not towards max_seconds
  StopControl(double max_seconds, std::function<bool()> interrupted,
              double seconds_before = 0.0)
      : max_seconds_(max_seconds),
        interrupted_(std::move(interrupted)),
        seconds_before_(seconds_before) {}

  double Seconds() const { return seconds_before_ + SecondsOfThisRun(); }

  // While one exists, what is worth finishing is not stopped: one more rollout, so that
  // what was found until then is not lost.
  class Grace {
   public:
    explicit Grace(StopControl* stop) : stop_(stop) { stop_->has_grace_ = true; }
    ~Grace() { stop_->has_grace_ = false; }
    Grace(const Grace&) = delete;
    Grace& operator=(const Grace&) = delete;

   private:
    StopControl* stop_;
  };

  // True from the first time on that there is a reason to stop.
  bool Poll() {
    if (has_grace_) return false;
    if (!was_interrupted_ && interrupted_ && interrupted_()) was_interrupted_ = true;
    if (!ran_out_of_time_ && SecondsOfThisRun() >= max_seconds_)
      ran_out_of_time_ = true;
    return stopped();
  }

  bool stopped() const { return was_interrupted_ || ran_out_of_time_; }
  bool was_interrupted() const { return was_interrupted_; }
  bool ran_out_of_time() const { return ran_out_of_time_; }

 private:
  using Clock = std::chrono::steady_clock;

  double SecondsOfThisRun() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
  }

  Clock::time_point start_ = Clock::now();
  double max_seconds_;
  std::function<bool()> interrupted_;
  double seconds_before_;
  // Rollouts of several objects may poll from several threads.
  std::atomic<bool> was_interrupted_{false};
  std::atomic<bool> ran_out_of_time_{false};
  std::atomic<bool> has_grace_{false};
};

}  // namespace dpe

#endif  // DPE_ESTIMATION_STOP_CONTROL_H_
