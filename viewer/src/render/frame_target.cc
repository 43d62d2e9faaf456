#include "render/frame_target.h"

#include <utility>
#include <vector>

#include "vk/buffer.h"
#include "vk/check.h"

namespace dpe::viewer {
namespace {

using vk::Attachment;
using vk::Device;

Attachment MakeImage(const Device& device, const RenderPasses& passes,
                     VkExtent2D extent) {
  Attachment::Options options;
  options.extent = extent;
  options.format = passes.formats().plain;
  options.other_format = passes.formats().srgb;
  options.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  return {device, options};
}

Attachment MakeSamples(const Device& device, const RenderPasses& passes,
                       VkExtent2D extent) {
  if (passes.samples() == VK_SAMPLE_COUNT_1_BIT) return {};
  Attachment::Options options;
  options.extent = extent;
  options.format = passes.formats().srgb;
  options.usage =
      VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
  options.samples = passes.samples();
  return {device, options};
}

Attachment MakeDepth(const Device& device, const RenderPasses& passes,
                     VkExtent2D extent) {
  Attachment::Options options;
  options.extent = extent;
  options.format = device.depth_format();
  options.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT |
                  VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
  options.aspect = VK_IMAGE_ASPECT_DEPTH_BIT;
  options.samples = passes.samples();
  return {device, options};
}

vk::FramebufferHandle MakeFramebuffer(const Device& device, VkRenderPass pass,
                                      VkExtent2D extent,
                                      const std::vector<VkImageView>& views) {
  VkFramebufferCreateInfo info{VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO};
  info.renderPass = pass;
  info.attachmentCount = static_cast<std::uint32_t>(views.size());
  info.pAttachments = views.data();
  info.width = extent.width;
  info.height = extent.height;
  info.layers = 1;
  VkFramebuffer framebuffer = VK_NULL_HANDLE;
  vk::Check(vkCreateFramebuffer(device.get(), &info, nullptr, &framebuffer),
            "creating a framebuffer");
  return {device.get(), framebuffer};
}

void RecordCopy(VkCommandBuffer commands, VkImage image, VkExtent2D extent,
                VkBuffer buffer) {
  VkBufferImageCopy region{};
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.imageExtent = {extent.width, extent.height, 1};
  vkCmdCopyImageToBuffer(commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer,
                         1, &region);
  VkMemoryBarrier to_host{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
  to_host.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  to_host.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT,
                       VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &to_host, 0, nullptr, 0,
                       nullptr);
}

}  // namespace

FrameTarget::FrameTarget(const Device& device, const RenderPasses& passes,
                         VkExtent2D extent)
    : extent_(extent),
      starts_with_blue_(passes.formats().starts_with_blue()),
      image_(MakeImage(device, passes, extent)),
      samples_(MakeSamples(device, passes, extent)),
      depth_(MakeDepth(device, passes, extent)) {
  const VkImageView srgb = image_.other_view();
  std::vector<VkImageView> views{srgb, depth_.view()};
  if (samples_.view() != VK_NULL_HANDLE) views = {samples_.view(), depth_.view(), srgb};
  scene_ = MakeFramebuffer(device, passes.scene(), extent, views);
  ui_ = MakeFramebuffer(device, passes.ui(), extent, {image_.view()});
}

Image FrameTarget::Read(const Device& device) const {
  const std::size_t bytes = std::size_t{4} * extent_.width * extent_.height;
  const vk::Buffer buffer(device, bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, vk::kShared);
  device.Run([&](VkCommandBuffer commands) {
    RecordCopy(commands, image_.image(), extent_, buffer.get());
  });
  const auto* pixels = static_cast<const std::uint8_t*>(buffer.mapped());
  Image image{static_cast<int>(extent_.width), static_cast<int>(extent_.height),
              std::vector<std::uint8_t>(pixels, pixels + bytes)};
  if (starts_with_blue_) {
    for (std::size_t i = 0; i < bytes; i += 4)
      std::swap(image.rgba[i], image.rgba[i + 2]);
  }
  // Translucent drawing leaves its mark in the opacity, which windows do not show.
  for (std::size_t i = 3; i < bytes; i += 4) image.rgba[i] = 255;
  return image;
}

}  // namespace dpe::viewer
