// What is played, how it is looked at, and everything that can be done to it.
#ifndef DPE_VIEWER_APP_SESSION_H_
#define DPE_VIEWER_APP_SESSION_H_

#include <string>

#include "picture/picture.h"
#include "playback/player.h"
#include "scene_view/camera.h"
#include "scene_view/picture_maker.h"

namespace dpe::viewer {

enum class Action {
  kNone,
  kTogglePause,
  kStepForward,
  kStepBack,
  kRestart,
  kResetCamera,
  kFrame,
  kZoomIn,
  kZoomOut,
  kSavePng,
  kHelp,
  kQuit,
};

class Session {
 public:
  Session(PlayerSources sources, Deviations deviations, const ViewOptions& view);

  // Brings what is shown up to date. True if the picture changed. @param now  s
  bool Update(double now);
  // True while the picture changes by itself.
  bool IsMoving() const { return !player_.paused() || player_.IsWaiting(); }
  // @param width, height  of the picture
  // @param left           pixels of it that something covers from the left
  Picture MakePicture(int width, int height, int left = 0);

  void Do(Action action);
  void SetColor(ColorMode mode);
  // Motions of the pointer in pixels of a window of that height.
  void Orbit(double dx, double dy, double height);
  void Pan(double dx, double dy, double height);
  void Zoom(double steps);

  // Writes the scene with its parameters as they are turned; says in message() how that
  // went.
  void SaveScene(const std::string& path);

  Player& player() { return player_; }
  const Player& player() const { return player_; }
  ViewOptions& view() { return view_; }
  const ViewOptions& view() const { return view_; }
  OrbitCamera& camera() { return camera_; }
  const OrbitCamera& camera() const { return camera_; }
  const PictureMaker& maker() const { return maker_; }

  bool wants_quit() const { return wants_quit_; }
  bool shows_help() const { return shows_help_; }
  bool wants_png() const { return wants_png_; }
  // Once per request.
  bool TakePngRequest();
  const std::string& message() const { return message_; }
  void set_message(std::string message);

 private:
  Player player_;
  PictureMaker maker_;
  OrbitCamera camera_;
  ViewOptions view_;
  bool wants_quit_ = false, shows_help_ = false, wants_png_ = false;
  bool changed_ = true;
  std::string message_;
};

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_APP_SESSION_H_
