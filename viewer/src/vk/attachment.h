// Images that are drawn on.
#ifndef DPE_VIEWER_VK_ATTACHMENT_H_
#define DPE_VIEWER_VK_ATTACHMENT_H_

#include <vulkan/vulkan.h>

#include "vk/device.h"
#include "vk/handle.h"

namespace dpe::viewer::vk {

// An image in the device's memory, with a view of all of it.
class Attachment {
 public:
  struct Options {
    VkExtent2D extent{};
    VkFormat format = VK_FORMAT_UNDEFINED;
    // Of a second view of the same bytes, if wanted.
    VkFormat other_format = VK_FORMAT_UNDEFINED;
    VkImageUsageFlags usage = 0;
    VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  };

  Attachment() = default;
  Attachment(const Device& device, const Options& options);

  VkImage image() const { return image_.get(); }
  VkImageView view() const { return view_.get(); }
  VkImageView other_view() const { return other_view_.get(); }

 private:
  void Allocate(const Device& device);

  // Destroyed from the last to the first.
  MemoryHandle memory_;
  ImageHandle image_;
  ImageViewHandle view_;
  ImageViewHandle other_view_;
};

}  // namespace dpe::viewer::vk

#endif  // DPE_VIEWER_VK_ATTACHMENT_H_
