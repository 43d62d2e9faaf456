#include "render/frame_slot.h"

#include "vk/check.h"

namespace dpe::viewer {
namespace {

vk::FenceHandle MakeFence(const vk::Device& device) {
  VkFenceCreateInfo info{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
  // Nothing was submitted yet, so there is nothing to wait for.
  info.flags = VK_FENCE_CREATE_SIGNALED_BIT;
  VkFence fence = VK_NULL_HANDLE;
  vk::Check(vkCreateFence(device.get(), &info, nullptr, &fence), "creating a fence");
  return {device.get(), fence};
}

void BeginPass(VkCommandBuffer commands, VkRenderPass pass, VkFramebuffer framebuffer,
               VkExtent2D extent, const glm::vec4& background) {
  VkClearValue clear[2]{};
  clear[0].color = {{background.r, background.g, background.b, background.a}};
  clear[1].depthStencil = {1.0f, 0};
  VkRenderPassBeginInfo begin{VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO};
  begin.renderPass = pass;
  begin.framebuffer = framebuffer;
  begin.renderArea.extent = extent;
  begin.clearValueCount = 2;
  begin.pClearValues = clear;
  vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
}

}  // namespace

FrameSlot::FrameSlot(const vk::Device& device)
    : device_(device),
      commands_(device.MakeCommandBuffer()),
      done_(MakeFence(device)) {}

void FrameSlot::Wait() const {
  vk::Check(vkWaitForFences(device_.get(), 1, done_.address(), VK_TRUE, UINT64_MAX),
            "waiting for a frame");
}

void FrameSlot::Record(const Picture& picture, const RenderPasses& passes,
                       const FrameTarget& target, PictureDrawer* drawer, Gui* gui) {
  VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  vk::Check(vkBeginCommandBuffer(commands_, &begin), "beginning commands");
  drawer->Prepare(commands_, picture, &upload_);
  BeginPass(commands_, passes.scene(), target.scene(), target.extent(),
            picture.background);
  drawer->Draw(commands_, picture, upload_, target.extent());
  vkCmdEndRenderPass(commands_);
  BeginPass(commands_, passes.ui(), target.ui(), target.extent(), picture.background);
  gui->Draw(commands_);
  vkCmdEndRenderPass(commands_);
}

void FrameSlot::Submit(VkSemaphore wait, VkSemaphore signal) {
  vk::Check(vkEndCommandBuffer(commands_), "ending commands");
  vk::Check(vkResetFences(device_.get(), 1, done_.address()), "resetting a fence");
  device_.Submit(commands_, done_.get(), wait, signal);
}

}  // namespace dpe::viewer
