// Which graphics device to draw with, and what there is to choose from. No Vulkan
// types.
#ifndef DPE_VIEWER_VK_DEVICE_OPTIONS_H_
#define DPE_VIEWER_VK_DEVICE_OPTIONS_H_

#include <memory>
#include <string>
#include <vector>

#include "vk/validation_log.h"

namespace dpe::viewer {

struct DeviceOptions {
  // Empty: the best suitable one (discrete before integrated before virtual before
  // software). Digits: the index in ListDevices(). Anything else: a part of its name,
  // upper and lower case alike.
  std::string device;
  // Samples per pixel, 1, 2, 4 or 8: the most that the device can and that are not more
  // than these. With one, edges of surfaces have steps.
  int samples = 4;
  // Turns the validation layer on; throws VulkanError where it is not installed.
  bool validation = false;
  // Where messages of the validation layer go; null: nowhere. It may outlive the
  // renderer: what is not released is reported as the renderer ends.
  std::shared_ptr<ValidationLog> log;
};

// A device that Vulkan offers.
struct DeviceDescription {
  int index = 0;     // as in DeviceOptions::device
  std::string name;  // as the driver says it
  std::string kind;  // "discrete GPU", "integrated GPU", "virtual GPU", "CPU", "other"
  std::string driver;   // name and version, as far as known
  std::string version;  // of Vulkan, such as "1.3.230"
  // Why it cannot draw pictures, one reason each; empty if it can.
  std::vector<std::string> problems;
};

// All devices, in Vulkan's order. Throws VulkanError, with what to install, if there is
// no Vulkan at all; a machine without devices gives an empty list.
std::vector<DeviceDescription> ListDevices();

// One line: index, name, kind, versions, and what is missing if it is not suitable.
std::string Describe(const DeviceDescription& device);

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_VK_DEVICE_OPTIONS_H_
