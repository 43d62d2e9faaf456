// A frame that may be on its way to the device.
#ifndef DPE_VIEWER_RENDER_FRAME_SLOT_H_
#define DPE_VIEWER_RENDER_FRAME_SLOT_H_

#include <functional>

#include "render/frame_target.h"
#include "render/gui.h"
#include "render/picture_drawer.h"

namespace dpe::viewer {

// Its commands, what they read, and a fence that says when the device is done with
// both.
class FrameSlot {
 public:
  explicit FrameSlot(const vk::Device& device);

  // Until the device has finished what was last submitted.
  void Wait() const;
  // Begins commands and records both passes.
  void Record(const Picture& picture, const RenderPasses& passes,
              const FrameTarget& target, PictureDrawer* drawer, Gui* gui);
  VkCommandBuffer commands() const { return commands_; }
  // Ends the commands and hands them over. `wait` and `signal` may be null.
  void Submit(VkSemaphore wait, VkSemaphore signal);

 private:
  const vk::Device& device_;
  VkCommandBuffer commands_;
  vk::FenceHandle done_;
  PictureDrawer::Upload upload_;
};

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_RENDER_FRAME_SLOT_H_
