#include "vk/attachment.h"

#include "vk/check.h"

namespace dpe::viewer::vk {
namespace {

ImageHandle MakeImage(const Device& device, const Attachment::Options& options) {
  VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = options.format;
  info.extent = {options.extent.width, options.extent.height, 1};
  info.mipLevels = 1;
  info.arrayLayers = 1;
  info.samples = options.samples;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = options.usage;
  info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
  info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  if (options.other_format != VK_FORMAT_UNDEFINED) {
    info.flags |= VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT;
  }
  VkImage image = VK_NULL_HANDLE;
  Check(vkCreateImage(device.get(), &info, nullptr, &image), "creating an image");
  return {device.get(), image};
}

ImageViewHandle MakeView(const Device& device, VkImage image, VkFormat format,
                         VkImageAspectFlags aspect) {
  VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
  info.image = image;
  info.viewType = VK_IMAGE_VIEW_TYPE_2D;
  info.format = format;
  info.subresourceRange = {aspect, 0, 1, 0, 1};
  VkImageView view = VK_NULL_HANDLE;
  Check(vkCreateImageView(device.get(), &info, nullptr, &view), "viewing an image");
  return {device.get(), view};
}

}  // namespace

Attachment::Attachment(const Device& device, const Options& options)
    : image_(MakeImage(device, options)) {
  Allocate(device);
  view_ = MakeView(device, image_.get(), options.format, options.aspect);
  if (options.other_format != VK_FORMAT_UNDEFINED) {
    other_view_ = MakeView(device, image_.get(), options.other_format, options.aspect);
  }
}

void Attachment::Allocate(const Device& device) {
  VkMemoryRequirements needs{};
  vkGetImageMemoryRequirements(device.get(), image_.get(), &needs);
  VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
  info.allocationSize = needs.size;
  info.memoryTypeIndex =
      device.MemoryType(needs.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  VkDeviceMemory memory = VK_NULL_HANDLE;
  Check(vkAllocateMemory(device.get(), &info, nullptr, &memory),
        "allocating memory for an image");
  memory_ = MemoryHandle(device.get(), memory);
  Check(vkBindImageMemory(device.get(), image_.get(), memory, 0),
        "giving an image its memory");
}

}  // namespace dpe::viewer::vk
