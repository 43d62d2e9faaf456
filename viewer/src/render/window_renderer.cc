#include "render/window_renderer.h"

#define GLFW_INCLUDE_VULKAN
#include <GLFW/glfw3.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "render/frame_slot.h"
#include "render/window_copy.h"
#include "vk/check.h"
#include "vk/instance.h"
#include "vk/swapchain.h"
#include "vk/vulkan_error.h"

namespace dpe::viewer {
namespace {

// One is drawn while the other is shown.
constexpr std::size_t kFrames = 2;

std::vector<std::string> WindowExtensions() {
  std::uint32_t count = 0;
  const char** names = glfwGetRequiredInstanceExtensions(&count);
  if (names == nullptr) throw VulkanError("Vulkan: windows are not supported here");
  return {names, names + count};
}

class Surface {
 public:
  Surface(VkInstance instance, GLFWwindow* window) : instance_(instance) {
    vk::Check(glfwCreateWindowSurface(instance, window, nullptr, &surface_),
              "drawing on a window");
  }
  ~Surface() { vkDestroySurfaceKHR(instance_, surface_, nullptr); }
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;

  VkSurfaceKHR get() const { return surface_; }

 private:
  VkInstance instance_;
  VkSurfaceKHR surface_ = VK_NULL_HANDLE;
};

VkExtent2D FramebufferSize(GLFWwindow* window) {
  int width = 0;
  int height = 0;
  glfwGetFramebufferSize(window, &width, &height);
  return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

bool Same(VkExtent2D a, VkExtent2D b) {
  return a.width == b.width && a.height == b.height;
}

// All that a lost device takes with it. Destroyed from the last to the first.
class Gpu {
 public:
  Gpu(GLFWwindow* window, const DeviceOptions& options, Gui* gui)
      : window_(window),
        gui_(gui),
        instance_(options, WindowExtensions()),
        surface_(instance_.get(), window),
        device_(instance_.get(), surface_.get(), options.device),
        format_(vk::ChooseSurfaceFormat(device_, surface_.get())),
        passes_(device_, FormatsLike(format_.format)),
        drawer_(device_, passes_),
        slots_{FrameSlot(device_), FrameSlot(device_)},
        free_{vk::MakeSemaphore(device_), vk::MakeSemaphore(device_)} {
    gui_->Attach(device_, passes_);
  }
  ~Gpu() {
    vkDeviceWaitIdle(device_.get());
    gui_->Detach();
  }
  Gpu(const Gpu&) = delete;
  Gpu& operator=(const Gpu&) = delete;

  bool Draw(const Picture& picture, const std::function<void()>& draw_ui);
  Image Capture() const { return drawn_ ? target_->Read(device_) : Image{}; }
  const vk::Device& device() const { return device_; }
  int samples() const { return passes_.samples(); }

 private:
  bool FitToWindow();
  void Show(const Picture& picture, std::uint32_t image);

  GLFWwindow* window_;
  Gui* gui_;
  vk::Instance instance_;
  Surface surface_;
  vk::Device device_;
  VkSurfaceFormatKHR format_;
  RenderPasses passes_;
  PictureDrawer drawer_;
  std::array<FrameSlot, kFrames> slots_;
  std::array<vk::SemaphoreHandle, kFrames> free_;
  std::optional<FrameTarget> target_;
  std::unique_ptr<vk::Swapchain> swapchain_;
  VkExtent2D fitted_to_{};  // the window's size when the swapchain was made
  bool stale_ = false;
  bool drawn_ = false;  // something is in the target
  std::size_t next_ = 0;
};

// Makes swapchain and target fit; false if the window has no extent.
bool Gpu::FitToWindow() {
  const VkExtent2D size = FramebufferSize(window_);
  if (size.width == 0 || size.height == 0) return false;
  if (swapchain_ && !stale_ && Same(size, fitted_to_)) return true;
  device_.WaitIdle();
  auto swapchain = std::make_unique<vk::Swapchain>(device_, surface_.get(), format_,
                                                   size, swapchain_.get());
  swapchain_ = std::move(swapchain);
  stale_ = false;
  fitted_to_ = size;
  const VkExtent2D extent = swapchain_->extent();
  if (extent.width == 0 || extent.height == 0) {
    swapchain_.reset();
    return false;
  }
  if (!target_ || !Same(target_->extent(), extent)) {
    target_.reset();
    drawn_ = false;
    target_.emplace(device_, passes_, extent);
  }
  return true;
}

bool Gpu::Draw(const Picture& picture, const std::function<void()>& draw_ui) {
  // A window that is being resized may be out of date again as soon as it was fitted.
  for (int attempt = 0; attempt < 3; ++attempt) {
    if (!FitToWindow()) return false;
    slots_[next_].Wait();
    const auto image = swapchain_->Acquire(free_[next_].get(), &stale_);
    if (image) {
      gui_->Build(draw_ui, target_->extent());
      Show(picture, *image);
      return true;
    }
    if (!stale_) return false;
  }
  return false;
}

void Gpu::Show(const Picture& picture, std::uint32_t image) {
  FrameSlot& slot = slots_[next_];
  slot.Record(picture, passes_, *target_, &drawer_, gui_);
  RecordCopyToWindow(slot.commands(), target_->image(), swapchain_->image(image),
                     target_->extent());
  slot.Submit(free_[next_].get(), swapchain_->drawn(image));
  drawn_ = true;
  next_ = (next_ + 1) % kFrames;
  swapchain_->Present(image, &stale_);
}

}  // namespace

struct WindowRenderer::State {
  State(GLFWwindow* window_to_use, const DeviceOptions& options_to_use)
      : window(window_to_use), options(options_to_use), gui(window_to_use) {
    gpu.emplace(window, options, &gui);
  }

  bool Draw(const Picture& picture, const std::function<void()>& draw_ui) {
    if (losses_to_come > 0) {
      --losses_to_come;
      throw DeviceLostError("Vulkan: the device was lost, as a test asked for");
    }
    return gpu->Draw(picture, draw_ui);
  }

  // With another one of the same kind, if the driver has come back.
  void ReplaceDevice() {
    gpu.reset();
    gpu.emplace(window, options, &gui);
    ++devices_lost;
  }

  GLFWwindow* window;
  DeviceOptions options;
  Gui gui;
  std::optional<Gpu> gpu;
  int devices_lost = 0;
  int losses_to_come = 0;
};

WindowRenderer::WindowRenderer(GLFWwindow* window, const DeviceOptions& options)
    : state_(std::make_unique<State>(window, options)) {}

WindowRenderer::~WindowRenderer() = default;

bool WindowRenderer::Draw(const Picture& picture,
                          const std::function<void()>& draw_ui) {
  try {
    return state_->Draw(picture, draw_ui);
  } catch (const DeviceLostError&) {
    state_->ReplaceDevice();
  }
  return state_->Draw(picture, draw_ui);
}

Image WindowRenderer::Capture() { return state_->gpu->Capture(); }

const DeviceDescription& WindowRenderer::device() const {
  return state_->gpu->device().description();
}

int WindowRenderer::samples() const { return state_->gpu->samples(); }

int WindowRenderer::devices_lost() const { return state_->devices_lost; }

void WindowRenderer::LoseDevice(int times) { state_->losses_to_come = times; }

}  // namespace dpe::viewer
