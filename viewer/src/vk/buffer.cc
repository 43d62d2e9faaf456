#include "vk/buffer.h"

#include "vk/check.h"

namespace dpe::viewer::vk {

Buffer::Buffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage,
               VkMemoryPropertyFlags memory)
    : size_(size) {
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = size;
  info.usage = usage;
  info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
  VkBuffer buffer = VK_NULL_HANDLE;
  Check(vkCreateBuffer(device.get(), &info, nullptr, &buffer), "creating a buffer");
  buffer_ = BufferHandle(device.get(), buffer);
  VkMemoryRequirements needs{};
  vkGetBufferMemoryRequirements(device.get(), buffer, &needs);
  VkMemoryAllocateInfo allocation{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
  allocation.allocationSize = needs.size;
  allocation.memoryTypeIndex = device.MemoryType(needs.memoryTypeBits, memory);
  VkDeviceMemory object = VK_NULL_HANDLE;
  Check(vkAllocateMemory(device.get(), &allocation, nullptr, &object),
        "allocating memory for a buffer");
  memory_ = MemoryHandle(device.get(), object);
  Check(vkBindBufferMemory(device.get(), buffer, object, 0),
        "giving a buffer its memory");
  if (memory & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) {
    Check(vkMapMemory(device.get(), object, 0, VK_WHOLE_SIZE, 0, &mapped_),
          "mapping a buffer");
  }
}

}  // namespace dpe::viewer::vk
