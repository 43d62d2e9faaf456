#include "vk/check.h"

#include <string>

#include "vk/vulkan_error.h"

namespace dpe::viewer::vk {
namespace {

std::string Text(VkResult result) {
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "out of memory";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "out of the device's memory";
    case VK_ERROR_INITIALIZATION_FAILED:
      return "initialisation failed";
    case VK_ERROR_DEVICE_LOST:
      return "the device was lost";
    case VK_ERROR_LAYER_NOT_PRESENT:
      return "a layer is not installed";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
      return "an extension is not supported";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return "no driver for this version of Vulkan was found";
    case VK_ERROR_SURFACE_LOST_KHR:
      return "the window's surface was lost";
    case VK_ERROR_NATIVE_WINDOW_IN_USE_KHR:
      return "the window is used by another graphics library";
    default:
      return "VkResult " + std::to_string(result);
  }
}

}  // namespace

void Check(VkResult result, const char* what) {
  if (result >= 0) return;
  const std::string message = std::string("Vulkan: ") + what + ": " + Text(result);
  // A lost surface is mended in the same way: by making everything anew.
  if (result == VK_ERROR_DEVICE_LOST || result == VK_ERROR_SURFACE_LOST_KHR)
    throw DeviceLostError(message);
  throw VulkanError(message);
}

}  // namespace dpe::viewer::vk
