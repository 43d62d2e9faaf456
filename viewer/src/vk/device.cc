#include "vk/device.h"

#include <algorithm>

#include "vk/check.h"
#include "vk/vulkan_error.h"

namespace dpe::viewer::vk {
namespace {

Candidate Choose(VkInstance instance, VkSurfaceKHR surface, const std::string& wanted) {
  const std::vector<Candidate> candidates = FindDevices(instance, surface);
  std::vector<DeviceDescription> descriptions;
  for (const Candidate& candidate : candidates) {
    descriptions.push_back(candidate.description);
  }
  return candidates[ChooseDevice(descriptions, wanted)];
}

VkDevice MakeDevice(const Candidate& candidate, bool shows) {
  const float priority = 1.0f;
  VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
  queue.queueFamilyIndex = candidate.queue_family;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  std::vector<const char*> extensions;
  if (shows) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
  // A device with this extension (MoltenVK) insists on its being enabled. Its name is
  // spelled out because the macro is in a header of beta extensions.
  const char* const portability = "VK_KHR_portability_subset";
  const auto names = ExtensionNames(candidate.device);
  if (std::find(names.begin(), names.end(), portability) != names.end()) {
    extensions.push_back(portability);
  }
  VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  VkDevice device = VK_NULL_HANDLE;
  Check(vkCreateDevice(candidate.device, &info, nullptr, &device),
        "opening the device");
  return device;
}

VkSampleCountFlagBits Samples(VkPhysicalDevice device, int wanted) {
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(device, &properties);
  const VkSampleCountFlags both = properties.limits.framebufferColorSampleCounts &
                                  properties.limits.framebufferDepthSampleCounts;
  // The flags are the numbers themselves, and every device can do one.
  for (const auto samples :
       {VK_SAMPLE_COUNT_8_BIT, VK_SAMPLE_COUNT_4_BIT, VK_SAMPLE_COUNT_2_BIT}) {
    if (static_cast<int>(samples) <= wanted && (both & samples) != 0) return samples;
  }
  return VK_SAMPLE_COUNT_1_BIT;
}

// Vulkan promises one of the two.
VkFormat DepthFormat(VkPhysicalDevice device) {
  VkFormatProperties properties{};
  vkGetPhysicalDeviceFormatProperties(device, VK_FORMAT_D32_SFLOAT, &properties);
  return properties.optimalTilingFeatures &
                 VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT
             ? VK_FORMAT_D32_SFLOAT
             : VK_FORMAT_X8_D24_UNORM_PACK32;
}

}  // namespace

Device::Device(VkInstance instance, VkSurfaceKHR surface, const DeviceOptions& options)
    : instance_(instance), chosen_(Choose(instance, surface, options.device)) {
  samples_ = Samples(chosen_.device, options.samples);
  depth_format_ = DepthFormat(chosen_.device);
  vkGetPhysicalDeviceMemoryProperties(chosen_.device, &memory_);
  device_ = MakeDevice(chosen_, surface != VK_NULL_HANDLE);
  vkGetDeviceQueue(device_, chosen_.queue_family, 0, &queue_);
  VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
  pool.queueFamilyIndex = chosen_.queue_family;
  VkCommandPool command_pool = VK_NULL_HANDLE;
  const VkResult result = vkCreateCommandPool(device_, &pool, nullptr, &command_pool);
  if (result != VK_SUCCESS) vkDestroyDevice(device_, nullptr);
  Check(result, "creating a command pool");
  command_pool_ = CommandPoolHandle(device_, command_pool);
}

Device::~Device() {
  vkDeviceWaitIdle(device_);
  command_pool_ = {};
  vkDestroyDevice(device_, nullptr);
}

std::uint32_t Device::MemoryType(std::uint32_t allowed,
                                 VkMemoryPropertyFlags properties) const {
  for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i) {
    if ((allowed >> i & 1) &&
        (memory_.memoryTypes[i].propertyFlags & properties) == properties) {
      return i;
    }
  }
  throw VulkanError("Vulkan: the device has no memory of the kind that is needed");
}

VkCommandBuffer Device::MakeCommandBuffer() const {
  VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
  info.commandPool = command_pool_.get();
  info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  info.commandBufferCount = 1;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  Check(vkAllocateCommandBuffers(device_, &info, &commands),
        "allocating a command buffer");
  return commands;
}

void Device::Run(const std::function<void(VkCommandBuffer)>& record) const {
  VkCommandBuffer commands = MakeCommandBuffer();
  VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  Check(vkBeginCommandBuffer(commands, &begin), "beginning commands");
  record(commands);
  Check(vkEndCommandBuffer(commands), "ending commands");
  Submit(commands, VK_NULL_HANDLE, VK_NULL_HANDLE, VK_NULL_HANDLE);
  Check(vkQueueWaitIdle(queue_), "waiting for the device");
  vkFreeCommandBuffers(device_, command_pool_.get(), 1, &commands);
}

void Device::Submit(VkCommandBuffer commands, VkFence fence, VkSemaphore wait,
                    VkSemaphore signal) const {
  const VkPipelineStageFlags stage = VK_PIPELINE_STAGE_TRANSFER_BIT;
  VkSubmitInfo info{VK_STRUCTURE_TYPE_SUBMIT_INFO};
  info.commandBufferCount = 1;
  info.pCommandBuffers = &commands;
  if (wait != VK_NULL_HANDLE) {
    info.waitSemaphoreCount = 1;
    info.pWaitSemaphores = &wait;
    info.pWaitDstStageMask = &stage;
  }
  if (signal != VK_NULL_HANDLE) {
    info.signalSemaphoreCount = 1;
    info.pSignalSemaphores = &signal;
  }
  Check(vkQueueSubmit(queue_, 1, &info, fence), "submitting commands");
}

void Device::WaitIdle() const {
  Check(vkDeviceWaitIdle(device_), "waiting for the device");
}

}  // namespace dpe::viewer::vk
