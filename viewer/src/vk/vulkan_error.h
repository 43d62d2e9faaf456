// What is thrown when Vulkan refuses.
#ifndef DPE_VIEWER_VK_VULKAN_ERROR_H_
#define DPE_VIEWER_VK_VULKAN_ERROR_H_

#include <stdexcept>
#include <string>

namespace dpe::viewer {

// A call failed, or no device is suitable; what() is written for the person at the
// program.
class VulkanError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The device is gone (driver restarted, card removed). Everything that was made with it
// has to be made anew.
class DeviceLostError : public VulkanError {
 public:
  using VulkanError::VulkanError;
};

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_VK_VULKAN_ERROR_H_
