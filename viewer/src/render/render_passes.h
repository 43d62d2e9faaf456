// The two passes of a frame: the scene, then the user interface on top.
//
// Light adds up linearly, so the scene is drawn with the sRGB view of the image, where
// the device converts as it blends and resolves. ImGui's colours are meant as they
// stand in the image, so the interface is drawn with the view that converts nothing.
#ifndef DPE_VIEWER_RENDER_RENDER_PASSES_H_
#define DPE_VIEWER_RENDER_RENDER_PASSES_H_

#include <vulkan/vulkan.h>

#include "vk/device.h"
#include "vk/handle.h"

namespace dpe::viewer {

// Two readings of the same bytes: as numbers, and as sRGB.
struct ColorFormats {
  VkFormat plain = VK_FORMAT_R8G8B8A8_UNORM;
  VkFormat srgb = VK_FORMAT_R8G8B8A8_SRGB;

  bool starts_with_blue() const { return plain == VK_FORMAT_B8G8R8A8_UNORM; }
};

class RenderPasses {
 public:
  // @param samples  per pixel, which the device must be able to
  RenderPasses(const vk::Device& device, const ColorFormats& formats,
               VkSampleCountFlagBits samples);

  // Attachments: color, depth, and with several samples the image they are resolved to.
  VkRenderPass scene() const { return scene_.get(); }
  // Attachment: the image. Leaves it as the source of a copy.
  VkRenderPass ui() const { return ui_.get(); }
  const ColorFormats& formats() const { return formats_; }
  VkSampleCountFlagBits samples() const { return samples_; }

 private:
  ColorFormats formats_;
  VkSampleCountFlagBits samples_;
  vk::RenderPassHandle scene_;
  vk::RenderPassHandle ui_;
};

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_RENDER_RENDER_PASSES_H_
