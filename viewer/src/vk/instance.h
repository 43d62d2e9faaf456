// The connection to Vulkan's loader and drivers.
#ifndef DPE_VIEWER_VK_INSTANCE_H_
#define DPE_VIEWER_VK_INSTANCE_H_

#include <vulkan/vulkan.h>

#include <memory>
#include <string>
#include <vector>

#include "vk/device_options.h"

namespace dpe::viewer::vk {

// Listens to the validation layer from before its instance is made until after it is
// destroyed, so that what was not released is heard of.
class Instance {
 public:
  // @param extensions  what the window needs; empty without one
  // Throws VulkanError if there is no Vulkan, or no validation layer though asked for.
  Instance(const DeviceOptions& options, const std::vector<std::string>& extensions);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  VkInstance get() const { return instance_; }

 private:
  std::shared_ptr<ValidationLog> log_;
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
};

}  // namespace dpe::viewer::vk

#endif  // DPE_VIEWER_VK_INSTANCE_H_
