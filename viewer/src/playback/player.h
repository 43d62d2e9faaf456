// What is played: up to two motions, simulated or recorded, and a recorded target, all
// at the same frame; paused, stepped and scrubbed together.
#ifndef DPE_VIEWER_PLAYBACK_PLAYER_H_
#define DPE_VIEWER_PLAYBACK_PLAYER_H_

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dpe/engine/scene.h"
#include "playback/history.h"
#include "playback/live_source.h"
#include "playback/recorded_motion.h"
#include "playback/tuning.h"

namespace dpe::viewer {

struct PlayerSources {
  Scene scene;
  std::optional<Scene> compared;             // simulated beside the scene
  std::optional<RecordedMotion> trajectory;  // the scene's motion, in place of a
                                             // simulation
  std::optional<RecordedMotion> target;
  std::function<void()> on_frame;  // see LiveSource
};

class Player {
 public:
  explicit Player(PlayerSources sources);

  const Scene& scene() const { return sources_.scene; }
  const Scene* compared() const;
  const RecordedMotion* target() const;
  bool is_live() const { return live_ != nullptr; }
  // True if the scene is simulated, so that its parameters can be turned.
  bool tunes_scene() const { return live_ != nullptr && !sources_.trajectory; }

  // Brings what is shown up to date. @param now  s, of any clock. True if something
  // changed.
  bool Update(double now);

  // What is shown.
  int frame() const { return frame_; }
  double time() const { return frame_ * sources_.scene.delta; }
  const MotionState& motion() const { return motion_; }
  const MotionState* compared_motion() const;  // null: none
  const MotionState* target_state() const;     // null: none, or markers only
  // Distance of the motion from the target by frame, m; NaN where it is not known.
  const std::vector<float>& errors() const { return errors_; }

  // The frames that can be shown.
  int first_frame() const;
  int last_frame() const;

  bool paused() const { return controls_.paused; }
  void SetPaused(bool paused);
  void Restart();
  // One frame on or back; pauses.
  void StepForward();
  void StepBack();
  // Shows a frame, pausing if it is a live simulation's past.
  void Seek(int frame);
  // True while a frame that was asked for is still being simulated.
  bool IsWaiting() const;

  double speed() const { return controls_.speed; }
  void SetSpeed(double speed);
  const Tuning& tuning() const { return controls_.tuning; }
  void SetTuning(const Tuning& tuning);

  // Of the simulation; 0 and empty without one.
  double frame_ms() const { return live_ ? live_->frame().frame_ms : 0.0; }
  double rate() const { return live_ ? live_->frame().rate : 0.0; }
  std::string failure() const { return live_ ? live_->frame().failure : ""; }

 private:
  void Show(int frame);
  void TakeLiveFrame();
  void NoteError(int frame, const MotionState& motion);
  bool AdvanceClock(double now);

  PlayerSources sources_;
  LiveControls controls_;
  std::unique_ptr<LiveSource> live_;
  History history_;
  long restarts_seen_ = 0;
  bool follow_ = true;  // shows the newest frame of the simulation
  int frame_ = 0;
  MotionState motion_, compared_motion_, target_state_;
  std::vector<float> errors_;
  double clock_ = 0.0, last_now_ = -1.0;  // s, of recordings alone
  bool changed_ = true;
};

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_PLAYBACK_PLAYER_H_
