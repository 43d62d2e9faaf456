#include "app/window_app.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <stdexcept>

#include "app/draft_policy.h"
#include "app/key_bindings.h"
#include "app/legend.h"
#include "app/offscreen_app.h"
#include "app/panel.h"
#include "app/session_io.h"
#include "imgui.h"
#include "png/png.h"
#include "render/window_renderer.h"

namespace dpe::viewer {
namespace {

// A picture is drawn this often after an event: ImGui shows some things one frame
// later.
constexpr int kDrawsAfterEvent = 3;
constexpr double kIdleSeconds = 1.0;  // nothing is missed: events end the wait
constexpr double kHiddenSeconds = 0.25;
constexpr double kMotionSeconds = 0.25;  // after an event: more may come

// Taken to wake the window up, and when it comes and goes: at no other time.
std::mutex running_mutex;
bool is_running = false;

void SetRunning(bool value) {
  const std::lock_guard<std::mutex> lock(running_mutex);
  is_running = value;
}

std::string GlfwReason() {
  const char* reason = nullptr;
  glfwGetError(&reason);
  return reason != nullptr ? reason : "no reason given";
}

// GLFW and its window, for as long as it lives.
class GlfwSession {
 public:
  explicit GlfwSession(const WindowOptions& options) {
    if (glfwInit() != GLFW_TRUE) {
      throw std::runtime_error("no window can be opened: " + GlfwReason() +
                               " (--offscreen needs none)");
    }
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    window_ = glfwCreateWindow(options.width, options.height, options.title.c_str(),
                               nullptr, nullptr);
    if (window_ == nullptr) {
      const std::string reason = GlfwReason();
      glfwTerminate();
      throw std::runtime_error("no window can be opened: " + reason);
    }
    SetRunning(true);
  }
  ~GlfwSession() {
    SetRunning(false);
    glfwDestroyWindow(window_);
    glfwTerminate();
  }
  GlfwSession(const GlfwSession&) = delete;
  GlfwSession& operator=(const GlfwSession&) = delete;
  GLFWwindow* window() { return window_; }

 private:
  GLFWwindow* window_ = nullptr;
};

class WindowApp {
 public:
  WindowApp(const WindowOptions& options, Session* session)
      : options_(options), session_(session), glfw_(options) {
    if (!options.state_file.empty()) {
      state_file_.open(options.state_file);
      if (!state_file_) {
        throw std::runtime_error(options.state_file + ": cannot be written");
      }
    }
    SetCallbacks();
    renderer_ = std::make_unique<WindowRenderer>(window(), options.device);
    panel_.device = state_.device = renderer_->device().name;
    std::strncpy(panel_.save_path, options.save_path.c_str(),
                 sizeof(panel_.save_path) - 1);
  }

  void Run() {
    while (!session_->wants_quit() && glfwWindowShouldClose(window()) == GLFW_FALSE) {
      WaitForEvents();
      if (session_->Update(glfwGetTime())) draws_left_ = std::max(draws_left_, 1);
      // A draft does not stay.
      if (state_.is_draft && !IsInMotion()) draws_left_ = std::max(draws_left_, 1);
      // Of a hidden window nothing says when it can be drawn again but a try.
      if (session_->IsMoving() || !is_visible_) draws_left_ = std::max(draws_left_, 1);
      if (draws_left_ == 0) continue;
      --draws_left_;
      Draw();
    }
  }

 private:
  GLFWwindow* window() { return glfw_.window(); }

  // With vsync Draw waits for the display; where there is none, this does.
  void WaitForEvents() {
    if (!is_visible_) {
      glfwWaitEventsTimeout(kHiddenSeconds);
    } else if (draws_left_ == 0 && !session_->IsMoving()) {
      // What a hand moves stands still when no more events come.
      glfwWaitEventsTimeout(state_.is_draft ? kMotionSeconds : kIdleSeconds);
    } else {
      const double left = last_draw_ + 1.0 / RefreshRate() - glfwGetTime();
      if (left > 1e-3) {
        glfwWaitEventsTimeout(left);
      } else {
        glfwPollEvents();
      }
    }
  }

  // Things move by themselves, or a person moves them.
  bool IsInMotion() const {
    return session_->IsMoving() || glfwGetTime() < last_event_ + kMotionSeconds;
  }

  static double RefreshRate() {
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
    return mode != nullptr && mode->refreshRate > 0 ? mode->refreshRate : 60.0;
  }

  void Draw() {
    // An event of the simulation may come long before the next picture is due.
    const double now = glfwGetTime();
    is_visible_ = !IsMinimised();
    if (!is_visible_) return;
    glfwGetFramebufferSize(window(), &state_.width, &state_.height);
    const Picture picture =
        session_->MakePicture(state_.width, state_.height, kPanelWidth);
    state_.is_draft = drafts_.Next(IsInMotion()) && !session_->wants_png() &&
                      renderer_->samples() > 1;
    is_visible_ = renderer_->Draw(
        picture,
        [this] {
          DrawLegend(*session_);
          DrawPanel(&panel_, session_);
          DrawHelp(*session_);
        },
        state_.is_draft);
    if (!is_visible_) return;
    drafts_.Took(glfwGetTime() - now);
    ++state_.pictures;
    if (last_draw_ > 0.0 && session_->IsMoving()) {
      const double rate = 1.0 / std::max(now - last_draw_, 1e-6);
      double& smoothed = state_.pictures_per_second;
      smoothed = smoothed == 0.0 ? rate : smoothed + 0.05 * (rate - smoothed);
    }
    last_draw_ = now;
    panel_.pictures_per_second = state_.pictures_per_second;
    state_.widgets = panel_.widgets;
    if (session_->TakePngRequest()) SavePng();
    WriteState();
  }

  // Some systems say it by a size of 0 by 0; X11 leaves the size as it is.
  bool IsMinimised() {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window(), &width, &height);
    return width == 0 || height == 0 ||
           glfwGetWindowAttrib(window(), GLFW_ICONIFIED) == GLFW_TRUE;
  }

  void SavePng() {
    try {
      int number = 1;
      std::string name = NumberedName(options_.png, number);
      while (std::filesystem::exists(name)) {
        name = NumberedName(options_.png, ++number);
      }
      WritePng(name, renderer_->Capture());
      session_->set_message("Wrote " + name);
    } catch (const std::runtime_error& error) {
      session_->set_message(error.what());
    }
  }

  void WriteState() {
    if (!state_file_.is_open()) return;
    std::string key = StateKey(*session_, state_);
    if (key == last_key_) return;
    last_key_ = std::move(key);
    state_file_ << StateJson(*session_, state_) << std::endl;
  }

  void SetCallbacks() {
    glfwSetWindowUserPointer(window(), this);
    glfwSetKeyCallback(window(), [](GLFWwindow* w, int key, int, int action, int) {
      Of(w)->OnKey(key, action);
    });
    glfwSetMouseButtonCallback(window(),
                               [](GLFWwindow* w, int button, int action, int mods) {
                                 Of(w)->OnButton(button, action, mods);
                               });
    glfwSetCursorPosCallback(
        window(), [](GLFWwindow* w, double x, double y) { Of(w)->OnCursor(x, y); });
    glfwSetScrollCallback(window(),
                          [](GLFWwindow* w, double, double y) { Of(w)->OnScroll(y); });
    glfwSetFramebufferSizeCallback(window(),
                                   [](GLFWwindow* w, int, int) { Of(w)->OnEvent(); });
    glfwSetWindowRefreshCallback(window(), [](GLFWwindow* w) { Of(w)->OnEvent(); });
    glfwSetWindowIconifyCallback(window(),
                                 [](GLFWwindow* w, int) { Of(w)->OnEvent(); });
    glfwSetCharCallback(window(), [](GLFWwindow* w, unsigned) { Of(w)->OnEvent(); });
  }

  static WindowApp* Of(GLFWwindow* window) {
    return static_cast<WindowApp*>(glfwGetWindowUserPointer(window));
  }

  void OnEvent() {
    draws_left_ = kDrawsAfterEvent;
    last_event_ = glfwGetTime();
  }

  // Callbacks come after the renderer has made ImGui's context, or before it; then
  // nothing captures anything.
  bool UiTakesKeys() const {
    return renderer_ != nullptr && ImGui::GetIO().WantTextInput;
  }
  bool UiTakesMouse() const {
    return renderer_ != nullptr && ImGui::GetIO().WantCaptureMouse;
  }

  void OnKey(int key, int action) {
    OnEvent();
    if (action == GLFW_RELEASE || UiTakesKeys()) return;
    const KeyBinding binding = BindingOf(key);
    // A key that is held down repeats what is gradual, and nothing else.
    if (action == GLFW_REPEAT && !binding.repeats) return;
    if (binding.color) session_->SetColor(*binding.color);
    session_->Do(binding.action);
  }

  void OnButton(int button, int action, int mods) {
    OnEvent();
    state_.button_down = action == GLFW_PRESS;
    drags_ = state_.button_down && !UiTakesMouse();
    pans_ = button == GLFW_MOUSE_BUTTON_RIGHT || button == GLFW_MOUSE_BUTTON_MIDDLE ||
            (mods & GLFW_MOD_SHIFT) != 0;
  }

  void OnCursor(double x, double y) {
    OnEvent();
    const double dx = x - state_.cursor_x, dy = y - state_.cursor_y;
    state_.cursor_x = x;
    state_.cursor_y = y;
    if (!drags_) return;
    int width = 0, height = 0;
    glfwGetWindowSize(window(), &width, &height);
    if (height <= 0) return;
    if (pans_) {
      session_->Pan(dx, dy, height);
    } else {
      session_->Orbit(dx, dy, height);
    }
  }

  void OnScroll(double steps) {
    OnEvent();
    if (!UiTakesMouse()) session_->Zoom(steps);
  }

  const WindowOptions& options_;
  Session* session_;
  GlfwSession glfw_;
  std::unique_ptr<WindowRenderer> renderer_;
  PanelState panel_;
  WindowState state_;
  std::ofstream state_file_;
  std::string last_key_;
  int draws_left_ = kDrawsAfterEvent;
  bool is_visible_ = true, drags_ = false, pans_ = false;
  double last_draw_ = 0.0, last_event_ = 0.0;
  DraftPolicy drafts_;
};

}  // namespace

void RunWindow(const WindowOptions& options, Session* session) {
  WindowApp(options, session).Run();
}

void WakeWindow() {
  const std::lock_guard<std::mutex> lock(running_mutex);
  if (is_running) glfwPostEmptyEvent();
}

}  // namespace dpe::viewer
