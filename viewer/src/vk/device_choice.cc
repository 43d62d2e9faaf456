#include "vk/device_choice.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <optional>

#include "vk/vulkan_error.h"

namespace dpe::viewer {
namespace {

std::string Lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char letter) { return std::tolower(letter); });
  return text;
}

int Rank(const DeviceDescription& device) {
  const char* const kinds[] = {"discrete GPU", "integrated GPU", "virtual GPU", "CPU"};
  return static_cast<int>(std::find(kinds, kinds + 4, device.kind) - kinds);
}

bool IsNumber(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos &&
         text.size() < 9;
}

bool IsMeant(const DeviceDescription& device, const std::string& wanted) {
  if (wanted.empty()) return true;
  if (IsNumber(wanted)) return device.index == std::atoi(wanted.c_str());
  return Lower(device.name).find(Lower(wanted)) != std::string::npos;
}

}  // namespace

std::string Describe(const DeviceDescription& device) {
  std::string text = std::to_string(device.index) + ": " + device.name + " (" +
                     device.kind + ", Vulkan " + device.version;
  if (!device.driver.empty()) text += ", " + device.driver;
  text += ")";
  for (std::size_t i = 0; i < device.problems.size(); ++i) {
    text += (i == 0 ? "; not suitable: " : "; ") + device.problems[i];
  }
  return text;
}

namespace vk {

int ChooseDevice(const std::vector<DeviceDescription>& devices,
                 const std::string& wanted) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    if (!devices[i].problems.empty() || !IsMeant(devices[i], wanted)) continue;
    if (!best || Rank(devices[i]) < Rank(devices[*best])) best = i;
  }
  if (best) return static_cast<int>(*best);
  std::string message = "Vulkan: no suitable device";
  if (!wanted.empty())
    message += " is meant by \"" + wanted + "\" (index or part of name)";
  message += devices.empty() ? "; there is none at all: install the driver of the "
                               "graphics card, or software Vulkan (Debian: "
                               "mesa-vulkan-drivers)"
                             : ". Found:";
  for (const DeviceDescription& device : devices) message += "\n  " + Describe(device);
  throw VulkanError(message);
}

}  // namespace vk
}  // namespace dpe::viewer
