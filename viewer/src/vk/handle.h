// Owners of Vulkan's objects.
#ifndef DPE_VIEWER_VK_HANDLE_H_
#define DPE_VIEWER_VK_HANDLE_H_

#include <vulkan/vulkan.h>

#include <utility>

namespace dpe::viewer::vk {

// Destroys its object with the function `Destroy` of the device that it was made with;
// may be moved. The device has to live longer.
template <typename Object,
          void (*Destroy)(VkDevice, Object, const VkAllocationCallbacks*)>
class Handle {
 public:
  Handle() = default;
  Handle(VkDevice device, Object object) : device_(device), object_(object) {}
  Handle(Handle&& other) noexcept { *this = std::move(other); }
  Handle& operator=(Handle&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(object_, other.object_);
    return *this;
  }
  ~Handle() {
    if (object_ != VK_NULL_HANDLE) Destroy(device_, object_, nullptr);
  }

  Object get() const { return object_; }
  // For arrays of one.
  const Object* address() const { return &object_; }
  explicit operator bool() const { return object_ != VK_NULL_HANDLE; }

 private:
  VkDevice device_ = VK_NULL_HANDLE;
  Object object_ = VK_NULL_HANDLE;
};

using BufferHandle = Handle<VkBuffer, vkDestroyBuffer>;
using CommandPoolHandle = Handle<VkCommandPool, vkDestroyCommandPool>;
using DescriptorPoolHandle = Handle<VkDescriptorPool, vkDestroyDescriptorPool>;
using FenceHandle = Handle<VkFence, vkDestroyFence>;
using FramebufferHandle = Handle<VkFramebuffer, vkDestroyFramebuffer>;
using ImageHandle = Handle<VkImage, vkDestroyImage>;
using ImageViewHandle = Handle<VkImageView, vkDestroyImageView>;
using MemoryHandle = Handle<VkDeviceMemory, vkFreeMemory>;
using PipelineHandle = Handle<VkPipeline, vkDestroyPipeline>;
using PipelineLayoutHandle = Handle<VkPipelineLayout, vkDestroyPipelineLayout>;
using RenderPassHandle = Handle<VkRenderPass, vkDestroyRenderPass>;
using SemaphoreHandle = Handle<VkSemaphore, vkDestroySemaphore>;
using ShaderModuleHandle = Handle<VkShaderModule, vkDestroyShaderModule>;
using SwapchainHandle = Handle<VkSwapchainKHR, vkDestroySwapchainKHR>;

}  // namespace dpe::viewer::vk

#endif  // DPE_VIEWER_VK_HANDLE_H_
