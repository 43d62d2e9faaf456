// Results of Vulkan's calls as exceptions.
#ifndef DPE_VIEWER_VK_CHECK_H_
#define DPE_VIEWER_VK_CHECK_H_

#include <vulkan/vulkan.h>

#include <cstdint>
#include <vector>

namespace dpe::viewer::vk {

// Throws VulkanError, or DeviceLostError for a lost device, if `result` is an error.
// @param what  what was attempted: "creating a buffer"
void Check(VkResult result, const char* what);

// Vulkan's two-call lists, such as vkEnumeratePhysicalDevices.
template <typename Item, typename Function, typename... Arguments>
std::vector<Item> List(Function function, Arguments... arguments) {
  std::vector<Item> items;
  std::uint32_t count = 0;
  VkResult result = VK_INCOMPLETE;
  // The list may grow between the two calls.
  while (result == VK_INCOMPLETE) {
    Check(function(arguments..., &count, nullptr), "asking for a list");
    items.resize(count);
    result = function(arguments..., &count, items.data());
  }
  Check(result, "asking for a list");
  items.resize(count);
  return items;
}

}  // namespace dpe::viewer::vk

#endif  // DPE_VIEWER_VK_CHECK_H_
