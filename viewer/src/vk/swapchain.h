// The images that a window shows in turn.
#ifndef DPE_VIEWER_VK_SWAPCHAIN_H_
#define DPE_VIEWER_VK_SWAPCHAIN_H_

#include <vulkan/vulkan.h>

#include <optional>
#include <vector>

#include "vk/device.h"
#include "vk/handle.h"

namespace dpe::viewer::vk {

SemaphoreHandle MakeSemaphore(const Device& device);

// The first of the formats with four bytes per pixel that the window can show as sRGB.
// Throws VulkanError if there is none.
VkSurfaceFormatKHR ChooseSurfaceFormat(const Device& device, VkSurfaceKHR surface);

// Shows images at the display's rate (FIFO, which every device has).
class Swapchain {
 public:
  // @param wanted  pixels, where the window leaves it to us
  // @param old  the one that is replaced, not in use any more; may be null
  Swapchain(const Device& device, VkSurfaceKHR surface, VkSurfaceFormatKHR format,
            VkExtent2D wanted, const Swapchain* old);

  VkExtent2D extent() const { return extent_; }
  VkImage image(std::uint32_t index) const { return images_[index]; }
  // What Present(index) waits for.
  VkSemaphore drawn(std::uint32_t index) const { return drawn_[index].get(); }

  // Acquire and Present set `stale` when the swapchain no longer fits the window and
  // has to be replaced.
  // @return the index of an image that may be drawn on once `free` is signalled; none
  // if
  //   the swapchain is of no use any more, or the display takes no image for a second
  std::optional<std::uint32_t> Acquire(VkSemaphore free, bool* stale);
  void Present(std::uint32_t index, bool* stale);

 private:
  const Device& device_;
  VkExtent2D extent_{};
  SwapchainHandle swapchain_;
  std::vector<VkImage> images_;
  std::vector<SemaphoreHandle> drawn_;
};

}  // namespace dpe::viewer::vk

#endif  // DPE_VIEWER_VK_SWAPCHAIN_H_
