// What a frame is drawn on: the image, and the samples and depths it is made from.
#ifndef DPE_VIEWER_RENDER_FRAME_TARGET_H_
#define DPE_VIEWER_RENDER_FRAME_TARGET_H_

#include "png/image.h"
#include "render/render_passes.h"
#include "vk/attachment.h"

namespace dpe::viewer {

// One serves all frames that are on their way: they are drawn one after the other, and
// copied from here to where they are shown.
class FrameTarget {
 public:
  FrameTarget(const vk::Device& device, const RenderPasses& passes, VkExtent2D extent);

  VkExtent2D extent() const { return extent_; }
  VkImage image() const { return image_.image(); }
  VkFramebuffer scene() const { return scene_.get(); }
  VkFramebuffer ui() const { return ui_.get(); }
  // The image as it is after both passes. Waits until the device is done with them.
  Image Read(const vk::Device& device) const;

 private:
  VkExtent2D extent_;
  bool starts_with_blue_;
  vk::Attachment image_;
  vk::Attachment samples_;  // none with one sample per pixel
  vk::Attachment depth_;
  vk::FramebufferHandle scene_;
  vk::FramebufferHandle ui_;
};

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_RENDER_FRAME_TARGET_H_
