// Dear ImGui on top of a picture.
#ifndef DPE_VIEWER_RENDER_GUI_H_
#define DPE_VIEWER_RENDER_GUI_H_

#include <vulkan/vulkan.h>

#include <functional>

#include "render/render_passes.h"
#include "vk/device.h"
#include "vk/handle.h"

struct GLFWwindow;
struct ImGuiContext;

namespace dpe::viewer {

// Owns the ImGui context, which outlives the device: panels stay as they are when a
// lost device is replaced. The context is current while the Gui exists (with several,
// that of the last Build).
class Gui {
 public:
  // @param window  whose events ImGui gets; null: none
  explicit Gui(GLFWwindow* window);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  // Puts fonts and pipelines into the device's memory. Detach before the device ends.
  void Attach(const vk::Device& device, const RenderPasses& passes);
  void Detach();

  // Runs draw_ui between NewFrame and Render; what it throws is passed on.
  void Build(const std::function<void()>& draw_ui, VkExtent2D extent);
  // Inside the pass for the interface: draws what was built, once.
  void Draw(VkCommandBuffer commands);

 private:
  GLFWwindow* window_;
  ImGuiContext* context_;
  bool attached_ = false;
  bool built_ = false;
  vk::DescriptorPoolHandle descriptors_;
};

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_RENDER_GUI_H_
