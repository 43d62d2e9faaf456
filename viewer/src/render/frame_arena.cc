#include "render/frame_arena.h"

namespace dpe::viewer {

void FrameArena::Restart(const vk::Device& device, VkDeviceSize bytes) {
  used_ = 0;
  if (bytes <= buffer_.size() && buffer_.size() > 0) return;
  buffer_ =
      vk::Buffer(device, bytes + bytes / 2 + 4096,
                 VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                 vk::kShared);
}

}  // namespace dpe::viewer
