#include "app/session.h"

#include <algorithm>
#include <utility>

#include "dpe/engine/scene_io.h"

namespace dpe::viewer {

Session::Session(PlayerSources sources, Deviations deviations, const ViewOptions& view)
    : player_(std::move(sources)),
      maker_(player_.scene(), player_.compared(), std::move(deviations)),
      view_(view) {
  camera_.SetHome(maker_.home());
}

bool Session::Update(double now) {
  const bool moved = player_.Update(now);
  return std::exchange(changed_, false) || moved;
}

Picture Session::MakePicture(int width, int height, int left) {
  Picture picture = maker_.Make(player_, view_);
  picture.camera = camera_.Get(width, height, std::min(left, width / 2));
  return picture;
}

void Session::Do(Action action) {
  changed_ = true;
  switch (action) {
    case Action::kNone:
      break;
    case Action::kTogglePause:
      player_.SetPaused(!player_.paused());
      break;
    case Action::kStepForward:
      player_.StepForward();
      break;
    case Action::kStepBack:
      player_.StepBack();
      break;
    case Action::kRestart:
      player_.Restart();
      maker_.ForgetScales();
      break;
    case Action::kResetCamera:
      camera_.Reset();
      break;
    case Action::kFrame:
      camera_.Frame(maker_.BallAboutNow(player_));
      break;
    case Action::kZoomIn:
      camera_.Zoom(1.0f);
      break;
    case Action::kZoomOut:
      camera_.Zoom(-1.0f);
      break;
    case Action::kSavePng:
      wants_png_ = true;
      break;
    case Action::kHelp:
      shows_help_ = !shows_help_;
      break;
    case Action::kQuit:
      wants_quit_ = true;
      break;
  }
}

void Session::SetColor(ColorMode mode) {
  view_.color = mode;
  changed_ = true;
}

void Session::Orbit(double dx, double dy, double height) {
  camera_.Orbit(static_cast<float>(dx), static_cast<float>(dy),
                static_cast<float>(height));
  changed_ = true;
}

void Session::Pan(double dx, double dy, double height) {
  camera_.Pan(static_cast<float>(dx), static_cast<float>(dy),
              static_cast<float>(height));
  changed_ = true;
}

void Session::Zoom(double steps) {
  camera_.Zoom(static_cast<float>(steps));
  changed_ = true;
}

void Session::SaveScene(const std::string& path) {
  try {
    dpe::SaveScene(player_.tunes_scene() ? TunedScene(player_.scene(), player_.tuning())
                                         : player_.scene(),
                   path);
    set_message("Wrote " + path);
  } catch (const SceneError& error) {
    set_message(error.what());
  }
}

bool Session::TakePngRequest() { return std::exchange(wants_png_, false); }

void Session::set_message(std::string message) {
  message_ = std::move(message);
  changed_ = true;
}

}  // namespace dpe::viewer
