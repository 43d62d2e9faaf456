#include "vk/instance.h"

#include <algorithm>
#include <cstring>

#include "vk/check.h"
#include "vk/vulkan_error.h"

namespace dpe::viewer::vk {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
// Devices need 1.1 only; 1.2 lets those that have it say which driver they are.
constexpr std::uint32_t kVersion = VK_API_VERSION_1_2;

VKAPI_ATTR VkBool32 VKAPI_CALL Listen(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                      VkDebugUtilsMessageTypeFlagsEXT,
                                      const VkDebugUtilsMessengerCallbackDataEXT* data,
                                      void* log) {
  static_cast<ValidationLog*>(log)->Add(data->pMessage);
  return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT MessengerInfo(ValidationLog* log) {
  VkDebugUtilsMessengerCreateInfoEXT info{
      VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
  info.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                         VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  // Not "general": the loader reports drivers of other hardware there.
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                     VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  info.pfnUserCallback = Listen;
  info.pUserData = log;
  return info;
}

bool HasExtension(const char* name) {
  const auto extensions = List<VkExtensionProperties>(
      vkEnumerateInstanceExtensionProperties, static_cast<const char*>(nullptr));
  return std::any_of(extensions.begin(), extensions.end(), [&](const auto& extension) {
    return std::strcmp(extension.extensionName, name) == 0;
  });
}

void RequireValidationLayer() {
  const auto layers = List<VkLayerProperties>(vkEnumerateInstanceLayerProperties);
  if (std::none_of(layers.begin(), layers.end(), [](const VkLayerProperties& layer) {
        return std::strcmp(layer.layerName, kValidationLayer) == 0;
      })) {
    throw VulkanError(std::string("Vulkan: the validation layer ") + kValidationLayer +
                      " is not installed (Debian: vulkan-validationlayers)");
  }
}

VkInstance MakeInstance(std::vector<const char*> extensions, ValidationLog* log) {
  VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
  application.pApplicationName = "dpe_viewer";
  application.apiVersion = kVersion;
  VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  info.pApplicationInfo = &application;
  // Without this the loader hides MoltenVK, whose Vulkan is not complete.
  if (HasExtension(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME)) {
    extensions.push_back(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
    info.flags |= VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR;
  }
  const VkDebugUtilsMessengerCreateInfoEXT messenger = MessengerInfo(log);
  if (log != nullptr) {
    RequireValidationLayer();
    extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &kValidationLayer;
    info.pNext = &messenger;
  }
  info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  VkInstance instance = VK_NULL_HANDLE;
  const VkResult result = vkCreateInstance(&info, nullptr, &instance);
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
    throw VulkanError(
        "Vulkan: no driver was found; install that of the graphics card, " +
        std::string("or software Vulkan (Debian: mesa-vulkan-drivers)"));
  }
  Check(result, "starting");
  return instance;
}

template <typename Function>
Function Load(VkInstance instance, const char* name) {
  return reinterpret_cast<Function>(vkGetInstanceProcAddr(instance, name));
}

}  // namespace

Instance::Instance(const DeviceOptions& options,
                   const std::vector<std::string>& extensions) {
  if (options.validation) {
    log_ = options.log ? options.log : std::make_shared<ValidationLog>();
  }
  std::vector<const char*> names;
  for (const std::string& extension : extensions) names.push_back(extension.c_str());
  instance_ = MakeInstance(std::move(names), log_.get());
  if (!log_) return;
  const auto create = Load<PFN_vkCreateDebugUtilsMessengerEXT>(
      instance_, "vkCreateDebugUtilsMessengerEXT");
  const VkDebugUtilsMessengerCreateInfoEXT info = MessengerInfo(log_.get());
  const VkResult result = create != nullptr
                              ? create(instance_, &info, nullptr, &messenger_)
                              : VK_ERROR_EXTENSION_NOT_PRESENT;
  if (result != VK_SUCCESS) {
    vkDestroyInstance(instance_, nullptr);
    Check(result, "listening to the validation layer");
  }
}

Instance::~Instance() {
  if (messenger_ != VK_NULL_HANDLE) {
    Load<PFN_vkDestroyDebugUtilsMessengerEXT>(
        instance_, "vkDestroyDebugUtilsMessengerEXT")(instance_, messenger_, nullptr);
  }
  vkDestroyInstance(instance_, nullptr);
}

}  // namespace dpe::viewer::vk
