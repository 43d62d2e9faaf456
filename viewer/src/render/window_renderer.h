// Draws pictures into a window.
#ifndef DPE_VIEWER_RENDER_WINDOW_RENDERER_H_
#define DPE_VIEWER_RENDER_WINDOW_RENDERER_H_

#include <functional>
#include <memory>

#include "picture/picture.h"
#include "png/image.h"
#include "vk/device_options.h"

struct GLFWwindow;

namespace dpe::viewer {

// On the thread of the window's events. Throws VulkanError where Vulkan refuses.
class WindowRenderer {
 public:
  // @param window  made with GLFW_CLIENT_API = GLFW_NO_API; outlives the renderer. Set
  //   its callbacks before: ImGui installs its own, which call those that were there.
  WindowRenderer(GLFWwindow* window, const DeviceOptions& options);
  ~WindowRenderer();
  WindowRenderer(const WindowRenderer&) = delete;
  WindowRenderer& operator=(const WindowRenderer&) = delete;

  // Draws one frame and queues it for the display; waits for the display (vsync) when
  // two frames are on their way. Follows the window's size. A lost device is made anew,
  // once: if the new one is lost too before it has shown a frame, DeviceLostError is
  // thrown.
  // @param draw_ui  as in OffscreenRenderer::Render; ImGui gets the window's events, so
  //   ask ImGui::GetIO().WantCaptureMouse before orbiting
  // @param draft  with one sample per pixel, for when time is short
  // @return false if nothing was drawn, because the window has no extent (minimised) or
  //   the display takes no frames (hidden); wait for events then, rather than draw at
  //   once
  bool Draw(const Picture& picture, const std::function<void()>& draw_ui = {},
            bool draft = false);

  // What the last Draw showed, waiting for it; empty (0 by 0) before the first.
  Image Capture();

  const DeviceDescription& device() const;
  int samples() const;  // of what is no draft
  // How often the device was made anew.
  int devices_lost() const;
  // For tests: the next attempts to draw find the device lost.
  void LoseDevice(int times = 1);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_RENDER_WINDOW_RENDERER_H_
