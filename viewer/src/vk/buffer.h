// Buffers: memory that the device reads or writes.
#ifndef DPE_VIEWER_VK_BUFFER_H_
#define DPE_VIEWER_VK_BUFFER_H_

#include <vulkan/vulkan.h>

#include "vk/device.h"
#include "vk/handle.h"

namespace dpe::viewer::vk {

// One allocation each: the viewer has about ten buffers, devices allow thousands.
class Buffer {
 public:
  Buffer() = default;
  // @param size  bytes, at least 1
  // @param memory  properties; HOST_VISIBLE memory is mapped as long as the buffer
  // lives
  Buffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage,
         VkMemoryPropertyFlags memory);

  VkBuffer get() const { return buffer_.get(); }
  VkDeviceSize size() const { return size_; }
  // Null unless HOST_VISIBLE.
  void* mapped() const { return mapped_; }

 private:
  // In this order: the buffer is destroyed before its memory is freed.
  MemoryHandle memory_;
  BufferHandle buffer_;
  VkDeviceSize size_ = 0;
  void* mapped_ = nullptr;
};

// Memory that the processor writes and the device reads, or the other way round,
// without flushes in between.
constexpr VkMemoryPropertyFlags kShared =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

}  // namespace dpe::viewer::vk

#endif  // DPE_VIEWER_VK_BUFFER_H_
