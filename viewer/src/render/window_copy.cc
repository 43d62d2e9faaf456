#include "render/window_copy.h"

namespace dpe::viewer {
namespace {

VkImageMemoryBarrier Transition(VkImage image, VkImageLayout from, VkImageLayout to) {
  VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
  barrier.oldLayout = from;
  barrier.newLayout = to;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  return barrier;
}

void Record(VkCommandBuffer commands, const VkImageMemoryBarrier& barrier,
            VkPipelineStageFlags after, VkPipelineStageFlags before) {
  vkCmdPipelineBarrier(commands, after, before, 0, 0, nullptr, 0, nullptr, 1, &barrier);
}

}  // namespace

ColorFormats FormatsLike(VkFormat window_format) {
  if (window_format == VK_FORMAT_B8G8R8A8_UNORM ||
      window_format == VK_FORMAT_B8G8R8A8_SRGB) {
    return {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_B8G8R8A8_SRGB};
  }
  return {VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_R8G8B8A8_SRGB};
}

void RecordCopyToWindow(VkCommandBuffer commands, VkImage drawn, VkImage shown,
                        VkExtent2D extent) {
  // The image is ours once the transfer stage has waited for it: see Device::Submit.
  VkImageMemoryBarrier barrier = Transition(shown, VK_IMAGE_LAYOUT_UNDEFINED,
                                            VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  barrier.dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  Record(commands, barrier, VK_PIPELINE_STAGE_TRANSFER_BIT,
         VK_PIPELINE_STAGE_TRANSFER_BIT);
  VkImageCopy region{};
  region.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.dstSubresource = region.srcSubresource;
  region.extent = {extent.width, extent.height, 1};
  vkCmdCopyImage(commands, drawn, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, shown,
                 VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
  barrier = Transition(shown, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                       VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
  barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  Record(commands, barrier, VK_PIPELINE_STAGE_TRANSFER_BIT,
         VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT);
}

}  // namespace dpe::viewer
