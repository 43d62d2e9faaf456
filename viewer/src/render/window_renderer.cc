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

// What depends on the number of samples per pixel.
struct Quality {
  Quality(const vk::Device& device, const ColorFormats& formats,
          VkSampleCountFlagBits samples)
      : passes(device, formats, samples), drawer(device, passes) {}

  RenderPasses passes;
  PictureDrawer drawer;
  std::optional<FrameTarget> target;
};

// All that a lost device takes with it. Destroyed from the last to the first.
class Gpu {
 public:
  Gpu(GLFWwindow* window, const DeviceOptions& options, Gui* gui)
      : window_(window),
        gui_(gui),
        instance_(options, WindowExtensions()),
        surface_(instance_.get(), window),
        device_(instance_.get(), surface_.get(), options),
        format_(vk::ChooseSurfaceFormat(device_, surface_.get())),
        full_(device_, FormatsLike(format_.format), device_.samples()),
        draft_(device_, FormatsLike(format_.format), VK_SAMPLE_COUNT_1_BIT),
        slots_{FrameSlot(device_), FrameSlot(device_)},
        free_{vk::MakeSemaphore(device_), vk::MakeSemaphore(device_)} {
    gui_->Attach(device_, full_.passes);
  }
  ~Gpu() {
    vkDeviceWaitIdle(device_.get());
    gui_->Detach();
  }
  Gpu(const Gpu&) = delete;
  Gpu& operator=(const Gpu&) = delete;

  bool Draw(const Picture& picture, const std::function<void()>& draw_ui, bool draft);
  Image Capture() const {
    return drawn_ != nullptr ? drawn_->target->Read(device_) : Image{};
  }
  const vk::Device& device() const { return device_; }
  int samples() const { return full_.passes.samples(); }

 private:
  bool FitToWindow();
  void FitToSwapchain(Quality* quality);
  void Show(const Picture& picture, std::uint32_t image, Quality* quality);

  GLFWwindow* window_;
  Gui* gui_;
  vk::Instance instance_;
  Surface surface_;
  vk::Device device_;
  VkSurfaceFormatKHR format_;
  Quality full_;
  // The interface's pass has one sample in both, so that ImGui is drawn in either.
  Quality draft_;
  std::array<FrameSlot, kFrames> slots_;
  std::array<vk::SemaphoreHandle, kFrames> free_;
  std::unique_ptr<vk::Swapchain> swapchain_;
  VkExtent2D fitted_to_{};  // the window's size when the swapchain was made
  bool stale_ = false;
  const Quality* drawn_ = nullptr;  // in whose target something is
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
  return true;
}

// The device has finished with a target of another size: it was idle when the swapchain
// was made.
void Gpu::FitToSwapchain(Quality* quality) {
  const VkExtent2D extent = swapchain_->extent();
  if (quality->target && Same(quality->target->extent(), extent)) return;
  if (drawn_ == quality) drawn_ = nullptr;
  quality->target.reset();
  quality->target.emplace(device_, quality->passes, extent);
}

bool Gpu::Draw(const Picture& picture, const std::function<void()>& draw_ui,
               bool draft) {
  Quality* const quality = draft ? &draft_ : &full_;
  // A window that is being resized may be out of date again as soon as it was fitted.
  for (int attempt = 0; attempt < 3; ++attempt) {
    if (!FitToWindow()) return false;
    FitToSwapchain(quality);
    slots_[next_].Wait();
    const auto image = swapchain_->Acquire(free_[next_].get(), &stale_);
    if (image) {
      gui_->Build(draw_ui, quality->target->extent());
      Show(picture, *image, quality);
      return true;
    }
    if (!stale_) return false;
  }
  return false;
}

void Gpu::Show(const Picture& picture, std::uint32_t image, Quality* quality) {
  FrameSlot& slot = slots_[next_];
  const FrameTarget& target = *quality->target;
  slot.Record(picture, quality->passes, target, &quality->drawer, gui_);
  RecordCopyToWindow(slot.commands(), target.image(), swapchain_->image(image),
                     target.extent());
  slot.Submit(free_[next_].get(), swapchain_->drawn(image));
  drawn_ = quality;
  next_ = (next_ + 1) % kFrames;
  swapchain_->Present(image, &stale_);
}

}  // namespace

struct WindowRenderer::State {
  State(GLFWwindow* window_to_use, const DeviceOptions& options_to_use)
      : window(window_to_use), options(options_to_use), gui(window_to_use) {
    gpu.emplace(window, options, &gui);
  }

  bool Draw(const Picture& picture, const std::function<void()>& draw_ui, bool draft) {
    if (losses_to_come > 0) {
      --losses_to_come;
      throw DeviceLostError("Vulkan: the device was lost, as a test asked for");
    }
    return gpu->Draw(picture, draw_ui, draft);
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

bool WindowRenderer::Draw(const Picture& picture, const std::function<void()>& draw_ui,
                          bool draft) {
  try {
    return state_->Draw(picture, draw_ui, draft);
  } catch (const DeviceLostError&) {
    state_->ReplaceDevice();
  }
  return state_->Draw(picture, draw_ui, draft);
}

Image WindowRenderer::Capture() { return state_->gpu->Capture(); }

const DeviceDescription& WindowRenderer::device() const {
  return state_->gpu->device().description();
}

int WindowRenderer::samples() const { return state_->gpu->samples(); }

int WindowRenderer::devices_lost() const { return state_->devices_lost; }

void WindowRenderer::LoseDevice(int times) { state_->losses_to_come = times; }

}  // namespace dpe::viewer
