#include "render/gui.h"

#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_vulkan.h>

#include "vk/check.h"

namespace dpe::viewer {
namespace {

// Of ImGui's own vertex buffers: at least as many as frames may be on their way.
constexpr std::uint32_t kImages = 3;

void CheckImGui(VkResult result) { vk::Check(result, "drawing the user interface"); }

vk::DescriptorPoolHandle MakeDescriptorPool(const vk::Device& device) {
  // One for the font, some for pictures.
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 16};
  VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  info.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
  info.maxSets = 16;
  info.poolSizeCount = 1;
  info.pPoolSizes = &size;
  VkDescriptorPool pool = VK_NULL_HANDLE;
  vk::Check(vkCreateDescriptorPool(device.get(), &info, nullptr, &pool),
            "creating a descriptor pool");
  return {device.get(), pool};
}

}  // namespace

Gui::Gui(GLFWwindow* window) : window_(window), context_(ImGui::CreateContext()) {
  ImGui::SetCurrentContext(context_);
  ImGui::GetIO().IniFilename = nullptr;
  if (window_ != nullptr) ImGui_ImplGlfw_InitForVulkan(window_, true);
}

Gui::~Gui() {
  Detach();
  ImGui::SetCurrentContext(context_);
  if (window_ != nullptr) ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext(context_);
}

void Gui::Attach(const vk::Device& device, const RenderPasses& passes) {
  ImGui::SetCurrentContext(context_);
  descriptors_ = MakeDescriptorPool(device);
  ImGui_ImplVulkan_InitInfo info{};
  info.Instance = device.instance();
  info.PhysicalDevice = device.physical();
  info.Device = device.get();
  info.QueueFamily = device.queue_family();
  info.Queue = device.queue();
  info.DescriptorPool = descriptors_.get();
  info.MinImageCount = kImages;
  info.ImageCount = kImages;
  info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
  info.CheckVkResultFn = CheckImGui;
  ImGui_ImplVulkan_Init(&info, passes.ui());
  attached_ = true;
  device.Run(
      [](VkCommandBuffer commands) { ImGui_ImplVulkan_CreateFontsTexture(commands); });
  ImGui_ImplVulkan_DestroyFontUploadObjects();
}

void Gui::Detach() {
  if (!attached_) return;
  ImGui::SetCurrentContext(context_);
  ImGui_ImplVulkan_Shutdown();
  descriptors_ = {};
  attached_ = false;
}

void Gui::Build(const std::function<void()>& draw_ui, VkExtent2D extent) {
  ImGui::SetCurrentContext(context_);
  built_ = false;
  if (!draw_ui) return;
  ImGui_ImplVulkan_NewFrame();
  if (window_ != nullptr) {
    ImGui_ImplGlfw_NewFrame();
  } else {
    ImGui::GetIO().DisplaySize = {static_cast<float>(extent.width),
                                  static_cast<float>(extent.height)};
    ImGui::GetIO().DeltaTime = 1.0f / 60.0f;
  }
  ImGui::NewFrame();
  try {
    draw_ui();
  } catch (...) {
    ImGui::EndFrame();
    throw;
  }
  ImGui::Render();
  built_ = true;
}

void Gui::Draw(VkCommandBuffer commands) {
  if (!built_) return;
  ImGui::SetCurrentContext(context_);
  ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), commands);
}

}  // namespace dpe::viewer
