// The device that draws, with its queue.
#ifndef DPE_VIEWER_VK_DEVICE_H_
#define DPE_VIEWER_VK_DEVICE_H_

#include <vulkan/vulkan.h>

#include <functional>
#include <string>

#include "vk/device_choice.h"
#include "vk/device_options.h"
#include "vk/handle.h"

namespace dpe::viewer::vk {

class Device {
 public:
  // @param surface  null: draws into memory only
  Device(VkInstance instance, VkSurfaceKHR surface, const DeviceOptions& options);
  // Waits until the device is idle.
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  VkDevice get() const { return device_; }
  VkPhysicalDevice physical() const { return chosen_.device; }
  VkInstance instance() const { return instance_; }
  VkQueue queue() const { return queue_; }
  std::uint32_t queue_family() const { return chosen_.queue_family; }
  const DeviceDescription& description() const { return chosen_.description; }
  VkCommandPool command_pool() const { return command_pool_.get(); }
  // Per pixel: of DeviceOptions::samples what colour and depth can both have.
  VkSampleCountFlagBits samples() const { return samples_; }
  VkFormat depth_format() const { return depth_format_; }

  // The type of memory that is in `allowed` and has `properties`. Throws VulkanError.
  std::uint32_t MemoryType(std::uint32_t allowed,
                           VkMemoryPropertyFlags properties) const;
  VkCommandBuffer MakeCommandBuffer() const;
  // Records, submits and waits.
  void Run(const std::function<void(VkCommandBuffer)>& record) const;
  // @param fence, wait, signal  may be null; `wait` holds the transfer stage back
  void Submit(VkCommandBuffer commands, VkFence fence, VkSemaphore wait,
              VkSemaphore signal) const;
  // Unlike the destructor, throws.
  void WaitIdle() const;

 private:
  VkInstance instance_;
  Candidate chosen_;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  CommandPoolHandle command_pool_;
  VkSampleCountFlagBits samples_ = VK_SAMPLE_COUNT_1_BIT;
  VkFormat depth_format_ = VK_FORMAT_D32_SFLOAT;
  VkPhysicalDeviceMemoryProperties memory_{};
};

}  // namespace dpe::viewer::vk

#endif  // DPE_VIEWER_VK_DEVICE_H_
