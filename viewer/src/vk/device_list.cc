// What is there, and what each device lacks.
#include <algorithm>

#include "vk/check.h"
#include "vk/device_choice.h"
#include "vk/instance.h"

namespace dpe::viewer {
namespace vk {
namespace {

std::string Kind(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return "discrete GPU";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return "integrated GPU";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return "virtual GPU";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return "CPU";
    default:
      return "other";
  }
}

std::string Version(std::uint32_t version) {
  return std::to_string(VK_API_VERSION_MAJOR(version)) + "." +
         std::to_string(VK_API_VERSION_MINOR(version)) + "." +
         std::to_string(VK_API_VERSION_PATCH(version));
}

std::string Driver(VkPhysicalDevice device) {
  VkPhysicalDeviceDriverProperties driver{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
  VkPhysicalDeviceProperties2 properties{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
  properties.pNext = &driver;
  vkGetPhysicalDeviceProperties2(device, &properties);
  return std::string(driver.driverName) + ", " + driver.driverInfo;
}

std::vector<VkQueueFamilyProperties> QueueFamilies(VkPhysicalDevice device) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  return families;
}

// Sets the queue family, or says what is missing.
void FindQueue(VkSurfaceKHR surface, Candidate* candidate) {
  const auto families = QueueFamilies(candidate->device);
  bool draws = false;
  for (std::uint32_t i = 0; i < families.size(); ++i) {
    if (!(families[i].queueFlags & VK_QUEUE_GRAPHICS_BIT)) continue;
    draws = true;
    VkBool32 shows = VK_TRUE;
    if (surface != VK_NULL_HANDLE) {
      Check(vkGetPhysicalDeviceSurfaceSupportKHR(candidate->device, i, surface, &shows),
            "asking whether a device can show a window");
    }
    if (shows) {
      candidate->queue_family = i;
      return;
    }
  }
  candidate->description.problems.push_back(
      draws ? "its queues that draw cannot show this window"
            : "it has no graphics queue, it computes only");
}

void CheckSurface(VkSurfaceKHR surface, Candidate* candidate) {
  const auto names = ExtensionNames(candidate->device);
  std::vector<std::string>& problems = candidate->description.problems;
  if (std::find(names.begin(), names.end(), VK_KHR_SWAPCHAIN_EXTENSION_NAME) ==
      names.end()) {
    problems.push_back("it cannot show windows (no VK_KHR_swapchain)");
    return;
  }
  VkSurfaceCapabilitiesKHR capabilities{};
  Check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(candidate->device, surface,
                                                  &capabilities),
        "asking what a window can show");
  if (!(capabilities.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_DST_BIT)) {
    problems.push_back("images cannot be copied into this window");
  }
}

Candidate Examine(VkPhysicalDevice device, int index, VkSurfaceKHR surface) {
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(device, &properties);
  Candidate candidate;
  candidate.device = device;
  DeviceDescription& description = candidate.description;
  description.index = index;
  description.name = properties.deviceName;
  description.kind = Kind(properties.deviceType);
  description.version = Version(properties.apiVersion);
  if (properties.apiVersion < VK_API_VERSION_1_1) {
    description.problems.push_back("its Vulkan is " + description.version +
                                   ", 1.1 is needed");
  }
  if (properties.apiVersion >= VK_API_VERSION_1_2) description.driver = Driver(device);
  FindQueue(surface, &candidate);
  if (surface != VK_NULL_HANDLE && description.problems.empty()) {
    CheckSurface(surface, &candidate);
  }
  return candidate;
}

}  // namespace

std::vector<std::string> ExtensionNames(VkPhysicalDevice device) {
  std::vector<std::string> names;
  for (const VkExtensionProperties& extension : List<VkExtensionProperties>(
           vkEnumerateDeviceExtensionProperties, device, nullptr)) {
    names.push_back(extension.extensionName);
  }
  return names;
}

std::vector<Candidate> FindDevices(VkInstance instance, VkSurfaceKHR surface) {
  std::vector<Candidate> candidates;
  for (VkPhysicalDevice device :
       List<VkPhysicalDevice>(vkEnumeratePhysicalDevices, instance)) {
    candidates.push_back(Examine(device, static_cast<int>(candidates.size()), surface));
  }
  return candidates;
}

}  // namespace vk

std::vector<DeviceDescription> ListDevices() {
  const vk::Instance instance({}, {});
  std::vector<DeviceDescription> descriptions;
  for (vk::Candidate& candidate : vk::FindDevices(instance.get(), VK_NULL_HANDLE)) {
    descriptions.push_back(std::move(candidate.description));
  }
  return descriptions;
}

}  // namespace dpe::viewer
