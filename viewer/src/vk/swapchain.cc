#include "vk/swapchain.h"

#include <algorithm>

#include "vk/check.h"
#include "vk/vulkan_error.h"

namespace dpe::viewer::vk {
namespace {

constexpr std::uint64_t kSecond = 1000000000;  // ns

VkSurfaceCapabilitiesKHR Capabilities(const Device& device, VkSurfaceKHR surface) {
  VkSurfaceCapabilitiesKHR capabilities{};
  Check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device.physical(), surface,
                                                  &capabilities),
        "asking what a window can show");
  return capabilities;
}

VkExtent2D Extent(const VkSurfaceCapabilitiesKHR& capabilities, VkExtent2D wanted) {
  if (capabilities.currentExtent.width != UINT32_MAX) return capabilities.currentExtent;
  const VkExtent2D least = capabilities.minImageExtent;
  const VkExtent2D most = capabilities.maxImageExtent;
  return {std::clamp(wanted.width, least.width, most.width),
          std::clamp(wanted.height, least.height, most.height)};
}

// One more than the display needs, so that drawing does not wait for it.
std::uint32_t ImageCount(const VkSurfaceCapabilitiesKHR& capabilities) {
  const std::uint32_t count = capabilities.minImageCount + 1;
  return capabilities.maxImageCount == 0 ? count
                                         : std::min(count, capabilities.maxImageCount);
}

VkCompositeAlphaFlagBitsKHR Alpha(const VkSurfaceCapabilitiesKHR& capabilities) {
  for (const VkCompositeAlphaFlagBitsKHR alpha :
       {VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR, VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR,
        VK_COMPOSITE_ALPHA_POST_MULTIPLIED_BIT_KHR}) {
    if (capabilities.supportedCompositeAlpha & alpha) return alpha;
  }
  return VK_COMPOSITE_ALPHA_PRE_MULTIPLIED_BIT_KHR;
}

}  // namespace

SemaphoreHandle MakeSemaphore(const Device& device) {
  const VkSemaphoreCreateInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
  VkSemaphore semaphore = VK_NULL_HANDLE;
  Check(vkCreateSemaphore(device.get(), &info, nullptr, &semaphore),
        "creating a semaphore");
  return {device.get(), semaphore};
}

VkSurfaceFormatKHR ChooseSurfaceFormat(const Device& device, VkSurfaceKHR surface) {
  const auto formats = List<VkSurfaceFormatKHR>(vkGetPhysicalDeviceSurfaceFormatsKHR,
                                                device.physical(), surface);
  for (const VkSurfaceFormatKHR& format : formats) {
    switch (format.format) {
      case VK_FORMAT_R8G8B8A8_UNORM:
      case VK_FORMAT_R8G8B8A8_SRGB:
      case VK_FORMAT_B8G8R8A8_UNORM:
      case VK_FORMAT_B8G8R8A8_SRGB:
        if (format.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR) return format;
        break;
      default:
        break;
    }
  }
  throw VulkanError(
      "Vulkan: the window shows sRGB in none of the formats with four "
      "bytes per pixel");
}

Swapchain::Swapchain(const Device& device, VkSurfaceKHR surface,
                     VkSurfaceFormatKHR format, VkExtent2D wanted, const Swapchain* old)
    : device_(device) {
  const VkSurfaceCapabilitiesKHR capabilities = Capabilities(device, surface);
  extent_ = Extent(capabilities, wanted);
  if (extent_.width == 0 || extent_.height == 0) return;
  VkSwapchainCreateInfoKHR info{VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR};
  info.surface = surface;
  info.minImageCount = ImageCount(capabilities);
  info.imageFormat = format.format;
  info.imageColorSpace = format.colorSpace;
  info.imageExtent = extent_;
  info.imageArrayLayers = 1;
  info.imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
  info.preTransform = capabilities.currentTransform;
  info.compositeAlpha = Alpha(capabilities);
  info.presentMode = VK_PRESENT_MODE_FIFO_KHR;
  info.clipped = VK_TRUE;
  info.oldSwapchain = old != nullptr ? old->swapchain_.get() : VK_NULL_HANDLE;
  VkSwapchainKHR swapchain = VK_NULL_HANDLE;
  Check(vkCreateSwapchainKHR(device.get(), &info, nullptr, &swapchain),
        "creating a swapchain");
  swapchain_ = SwapchainHandle(device.get(), swapchain);
  images_ = List<VkImage>(vkGetSwapchainImagesKHR, device.get(), swapchain);
  for (std::size_t i = 0; i < images_.size(); ++i) {
    drawn_.push_back(MakeSemaphore(device));
  }
}

std::optional<std::uint32_t> Swapchain::Acquire(VkSemaphore free, bool* stale) {
  std::uint32_t index = 0;
  const VkResult result = vkAcquireNextImageKHR(device_.get(), swapchain_.get(),
                                                kSecond, free, VK_NULL_HANDLE, &index);
  if (result == VK_ERROR_OUT_OF_DATE_KHR) *stale = true;
  if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_TIMEOUT ||
      result == VK_NOT_READY) {
    return std::nullopt;
  }
  if (result == VK_SUBOPTIMAL_KHR) *stale = true;
  Check(result, "asking the window for an image");
  return index;
}

void Swapchain::Present(std::uint32_t index, bool* stale) {
  const VkSwapchainKHR swapchain = swapchain_.get();
  VkPresentInfoKHR info{VK_STRUCTURE_TYPE_PRESENT_INFO_KHR};
  info.waitSemaphoreCount = 1;
  info.pWaitSemaphores = drawn_[index].address();
  info.swapchainCount = 1;
  info.pSwapchains = &swapchain;
  info.pImageIndices = &index;
  const VkResult result = vkQueuePresentKHR(device_.queue(), &info);
  if (result == VK_SUBOPTIMAL_KHR || result == VK_ERROR_OUT_OF_DATE_KHR) {
    *stale = true;
    return;
  }
  Check(result, "showing an image");
}

}  // namespace dpe::viewer::vk
