#include "render/render_passes.h"

#include <vector>

#include "vk/check.h"

namespace dpe::viewer {
namespace {

using vk::Device;

constexpr VkImageLayout kColorLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;

VkAttachmentDescription Description(VkFormat format, VkSampleCountFlagBits samples,
                                    bool clear, bool keep, VkImageLayout final_layout) {
  VkAttachmentDescription description{};
  description.format = format;
  description.samples = samples;
  description.loadOp =
      clear ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  description.storeOp =
      keep ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
  description.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  description.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  description.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  description.finalLayout = final_layout;
  return description;
}

vk::RenderPassHandle Make(const Device& device,
                          const std::vector<VkAttachmentDescription>& attachments,
                          const VkSubpassDescription& subpass,
                          const std::vector<VkSubpassDependency>& dependencies) {
  VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
  info.attachmentCount = static_cast<std::uint32_t>(attachments.size());
  info.pAttachments = attachments.data();
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  info.dependencyCount = static_cast<std::uint32_t>(dependencies.size());
  info.pDependencies = dependencies.data();
  VkRenderPass pass = VK_NULL_HANDLE;
  vk::Check(vkCreateRenderPass(device.get(), &info, nullptr, &pass),
            "creating a render pass");
  return {device.get(), pass};
}

vk::RenderPassHandle MakeScene(const Device& device, const ColorFormats& formats,
                               VkSampleCountFlagBits samples) {
  const bool resolves = samples != VK_SAMPLE_COUNT_1_BIT;
  std::vector<VkAttachmentDescription> attachments{
      Description(formats.srgb, samples, true, !resolves, kColorLayout),
      Description(device.depth_format(), samples, true, false,
                  VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL)};
  if (resolves) {
    attachments.push_back(
        Description(formats.srgb, VK_SAMPLE_COUNT_1_BIT, false, true, kColorLayout));
  }
  const VkAttachmentReference color{0, kColorLayout};
  const VkAttachmentReference depth{1,
                                    VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
  const VkAttachmentReference resolved{2, kColorLayout};
  VkSubpassDescription subpass{};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = 1;
  subpass.pColorAttachments = &color;
  subpass.pResolveAttachments = resolves ? &resolved : nullptr;
  subpass.pDepthStencilAttachment = &depth;
  // The frame before has been copied, and has finished with the images that frames
  // share.
  VkSubpassDependency before{};
  before.srcSubpass = VK_SUBPASS_EXTERNAL;
  before.srcStageMask = VK_PIPELINE_STAGE_TRANSFER_BIT |
                        VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT |
                        VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
  before.srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT |
                         VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
  before.dstStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT |
                        VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT;
  before.dstAccessMask = VK_ACCESS_COLOR_ATTACHMENT_READ_BIT |
                         VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT |
                         VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
                         VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
  return Make(device, attachments, subpass, {before});
}

vk::RenderPassHandle MakeUi(const Device& device, const ColorFormats& formats) {
  VkAttachmentDescription image =
      Description(formats.plain, VK_SAMPLE_COUNT_1_BIT, false, true,
                  VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
  image.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
  image.initialLayout = kColorLayout;
  const VkAttachmentReference color{0, kColorLayout};
  VkSubpassDescription subpass{};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = 1;
  subpass.pColorAttachments = &color;
  VkSubpassDependency scene_before{};
  scene_before.srcSubpass = VK_SUBPASS_EXTERNAL;
  scene_before.srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
  scene_before.srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
  scene_before.dstStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
  scene_before.dstAccessMask =
      VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
  VkSubpassDependency copy_after{};
  copy_after.dstSubpass = VK_SUBPASS_EXTERNAL;
  copy_after.srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
  copy_after.srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
  copy_after.dstStageMask = VK_PIPELINE_STAGE_TRANSFER_BIT;
  copy_after.dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT;
  return Make(device, {image}, subpass, {scene_before, copy_after});
}

}  // namespace

RenderPasses::RenderPasses(const Device& device, const ColorFormats& formats,
                           VkSampleCountFlagBits samples)
    : formats_(formats),
      samples_(samples),
      scene_(MakeScene(device, formats, samples_)),
      ui_(MakeUi(device, formats)) {}

}  // namespace dpe::viewer
