// Which of the devices draws.
#ifndef DPE_VIEWER_VK_DEVICE_CHOICE_H_
#define DPE_VIEWER_VK_DEVICE_CHOICE_H_

#include <vulkan/vulkan.h>

#include <string>
#include <vector>

#include "vk/device_options.h"

namespace dpe::viewer::vk {

// A device with what choosing it settles.
struct Candidate {
  VkPhysicalDevice device = VK_NULL_HANDLE;
  DeviceDescription description;
  std::uint32_t queue_family = 0;  // draws and, with a surface, shows
};

// @param surface  what has to be drawn on; null: memory only
std::vector<Candidate> FindDevices(VkInstance instance, VkSurfaceKHR surface);

// The index of the device that is meant by `wanted` (DeviceOptions::device). Throws
// VulkanError, which lists all devices and why each is not suitable, if there is none.
int ChooseDevice(const std::vector<DeviceDescription>& devices,
                 const std::string& wanted);

// The device's extensions, by name.
std::vector<std::string> ExtensionNames(VkPhysicalDevice device);

}  // namespace dpe::viewer::vk

#endif  // DPE_VIEWER_VK_DEVICE_CHOICE_H_
