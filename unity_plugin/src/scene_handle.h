// A scene and its thread.
//
// One mutex guards the simulation and the state; whoever computes a frame holds it, and
// lets go of it after each. It is a fair one: however fast frames follow each other,
// who wants to change something waits for one frame and for those who came before. The
// thread is made when the scene is first started, and ends with it.
#ifndef DPE_UNITY_SCENE_HANDLE_H_
#define DPE_UNITY_SCENE_HANDLE_H_

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

#include "call.h"
#include "dpe/c/scene.h"
#include "fair_mutex.h"
#include "handle_table.h"
#include "position_buffer.h"
#include "scene_model.h"

namespace dpe::c {

class SceneHandle : public HandleObject {
 public:
  static constexpr HandleKind kKind = HandleKind::kScene;

  // @throws SceneError
  SceneHandle(const Scene& scene, std::string warnings);
  ~SceneHandle() override;
  void Close() override;

  // What never changes can be read without waiting.
  const Scene& initial() const { return model_.initial(); }
  const std::string& warnings() const { return warnings_; }
  const PositionBuffer& positions() const { return positions_; }

  dpe_scene_info Info();
  // @throws ApiError; after a failure the frames before it stand
  void Step(int num_frames);
  void Start();
  void Pause();
  void Stop();
  void SetRate(double rate);

  // work(SceneModel&) between two frames.
  template <class Work>
  void Change(const Work& work) {
    const Access access(this);
    work(model_);
  }

 private:
  using Clock = std::chrono::steady_clock;

  // The mutex, between two frames; wakes the thread afterwards.
  class Access {
   public:
    explicit Access(SceneHandle* scene) : scene_(scene) { scene_->mutex_.lock(); }
    ~Access() {
      scene_->mutex_.unlock();
      scene_->wake_.notify_all();
    }
    Access(const Access&) = delete;
    Access& operator=(const Access&) = delete;

   private:
    SceneHandle* scene_;
  };

  void RequireOpen() const;
  void Publish();
  // One frame; false if it failed. The caller holds the mutex.
  bool Advance();
  void Run();
  // By the clock, at the present rate.
  Clock::duration FrameTime() const;

  const std::string warnings_;
  std::atomic<bool> closing_{false};
  std::atomic<bool> interrupted_{false};  // a frame that is being computed is given up
  FairMutex mutex_;                       // guards all that follows but positions_
  std::condition_variable_any wake_;
  SceneModel model_;
  int state_ = DPE_STOPPED;
  std::uint64_t stops_ = 0;  // how often it was stopped
  double rate_ = 1.0;
  Clock::time_point due_;  // of the next frame, where it runs
  std::thread thread_;
  PositionBuffer positions_;
};

}  // namespace dpe::c

#endif  // DPE_UNITY_SCENE_HANDLE_H_
