// Where a frame's vertices are put for the device to read.
#ifndef DPE_VIEWER_RENDER_FRAME_ARENA_H_
#define DPE_VIEWER_RENDER_FRAME_ARENA_H_

#include <cstring>
#include <vector>

#include "vk/buffer.h"

namespace dpe::viewer {

// A mapped buffer that is filled from the start, every frame anew. Every frame that may
// be on its way has its own, so that writing waits for no reader.
class FrameArena {
 public:
  // Forgets what was put; afterwards `bytes` fit, Padded() for each put. Only when the
  // device has finished the frame that was read from here. Allocates only if the buffer
  // was too small, and then by more than is needed.
  void Restart(const vk::Device& device, VkDeviceSize bytes);

  // Copies in, returns the offset in buffer().
  template <typename Item>
  VkDeviceSize Put(const std::vector<Item>& items) {
    const VkDeviceSize offset = used_;
    const std::size_t bytes = items.size() * sizeof(Item);
    // Of no item there may be no address either, which memcpy does not take.
    if (bytes > 0) {
      std::memcpy(static_cast<char*>(buffer_.mapped()) + offset, items.data(), bytes);
    }
    used_ += Padded(bytes);
    return offset;
  }
  VkBuffer buffer() const { return buffer_.get(); }

  static VkDeviceSize Padded(VkDeviceSize bytes) { return (bytes + 15) / 16 * 16; }

 private:
  vk::Buffer buffer_;
  VkDeviceSize used_ = 0;
};

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_RENDER_FRAME_ARENA_H_
