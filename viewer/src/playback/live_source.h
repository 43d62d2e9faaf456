// Scenes that are simulated, all in step, on a thread of their own.
//
// Neither side waits for the other: what to do goes one way and the newest state comes
// the other way through triple buffers. A frame takes as long as it takes; where that
// is more than its length, the simulation runs slower than time, and nothing else does.
#ifndef DPE_VIEWER_PLAYBACK_LIVE_SOURCE_H_
#define DPE_VIEWER_PLAYBACK_LIVE_SOURCE_H_

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "dpe/engine/live_simulation.h"
#include "dpe/engine/scene.h"
#include "playback/motion_state.h"
#include "playback/triple_buffer.h"
#include "playback/tuning.h"

namespace dpe::viewer {

// What the simulation shall do. Counters only grow, so that no request is lost when a
// newer set of controls overtakes an older one.
struct LiveControls {
  bool paused = true;
  long steps = 0;      // frames asked for while paused, all in all
  long restarts = 0;   // all in all
  double speed = 1.0;  // seconds simulated per second, at most
  Tuning tuning;       // of the first scene
};

struct LiveFrame {
  int frame = 0;
  long restarts = 0;                 // that had been done
  long steps = 0;                    // of those asked for, how many had been done
  std::vector<MotionState> motions;  // one per scene
  double frame_ms = 0.0;             // time that a frame takes, smoothed
  double rate = 0.0;    // seconds simulated per second, smoothed; 0: not known yet
  std::string failure;  // why it cannot go on; empty: it can
};

class LiveSource {
 public:
  // Starts paused, with the initial states as the first frame.
  // @param scenes    at least one, all with the same length of a frame
  // @param on_frame  called on the simulation's thread after each new frame; may be
  // empty
  // @throws SceneError for a scene that is not valid
  LiveSource(std::vector<Scene> scenes, std::function<void()> on_frame);
  ~LiveSource();
  LiveSource(const LiveSource&) = delete;
  LiveSource& operator=(const LiveSource&) = delete;

  // On one thread: what to do from now on.
  void Set(const LiveControls& controls);
  // On one thread: takes over the newest frame. False if there is none since the last
  // call.
  bool Update() { return frames_.Update(); }
  const LiveFrame& frame() const { return frames_.front(); }

 private:
  using Clock = std::chrono::steady_clock;

  void Run();
  void TakeControls();
  // One frame of every scene; false after a failure.
  bool Advance();
  void Publish();
  // Until the time, or until there are new controls.
  void Wait(Clock::time_point until);

  const std::vector<Scene> scenes_;
  std::function<void()> on_frame_;
  std::vector<std::unique_ptr<LiveSimulation>> simulations_;
  TripleBuffer<LiveControls> inbox_;
  TripleBuffer<LiveFrame> frames_;

  // Of the simulation's thread.
  LiveControls controls_;
  long steps_done_ = 0;
  double frame_ms_ = 0.0, turn_seconds_ = 0.0;
  std::string failure_;
  Clock::time_point due_, last_begin_;
  bool was_running_ = false;

  std::atomic<bool> stop_{false}, has_news_{false};
  std::mutex mutex_;  // of wake_up_ alone; no one holds it but to fall asleep
  std::condition_variable wake_up_;
  std::thread thread_;
};

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_PLAYBACK_LIVE_SOURCE_H_
