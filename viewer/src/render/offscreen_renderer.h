// Draws pictures into memory: no window, no X server.
#ifndef DPE_VIEWER_RENDER_OFFSCREEN_RENDERER_H_
#define DPE_VIEWER_RENDER_OFFSCREEN_RENDERER_H_

#include <functional>
#include <memory>
#include <string>

#include "picture/picture.h"
#include "png/image.h"
#include "vk/device_options.h"

namespace dpe::viewer {

// One thread at a time. Throws VulkanError where Vulkan refuses.
class OffscreenRenderer {
 public:
  // @param width, height  pixels of the images, at least 1
  OffscreenRenderer(const DeviceOptions& options, int width, int height);
  ~OffscreenRenderer();
  OffscreenRenderer(const OffscreenRenderer&) = delete;
  OffscreenRenderer& operator=(const OffscreenRenderer&) = delete;

  // Draws and waits for the result. Background, then surfaces, lines, points, each in
  // the order given, then the lines that are on top.
  // @param draw_ui  if there: called once with a current ImGui context, between
  // NewFrame
  //   and Render; what it draws covers the picture. The context (its DisplaySize is the
  //   image's) lives as long as the renderer, but is current in draw_ui only. No .ini
  //   file is read or written.
  Image Render(const Picture& picture, const std::function<void()>& draw_ui = {});

  // Of the device that draws.
  const DeviceDescription& device() const;
  // Per pixel, see DeviceOptions.
  int samples() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_RENDER_OFFSCREEN_RENDERER_H_
