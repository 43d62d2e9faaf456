#include "render/offscreen_renderer.h"

#include <stdexcept>

#include "render/frame_slot.h"
#include "vk/instance.h"

namespace dpe::viewer {
namespace {

VkExtent2D Extent(int width, int height) {
  if (width < 1 || height < 1) {
    throw std::invalid_argument("OffscreenRenderer: an image has at least one pixel");
  }
  return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

}  // namespace

// In the order in which things are made; destroyed the other way round.
struct OffscreenRenderer::State {
  State(const DeviceOptions& options, VkExtent2D extent)
      : instance(options, {}),
        device(instance.get(), VK_NULL_HANDLE, options),
        passes(device, {}, device.samples()),
        target(device, passes, extent),
        drawer(device, passes),
        slot(device),
        gui(nullptr) {
    gui.Attach(device, passes);
  }

  vk::Instance instance;
  vk::Device device;
  RenderPasses passes;
  FrameTarget target;
  PictureDrawer drawer;
  FrameSlot slot;
  Gui gui;
};

OffscreenRenderer::OffscreenRenderer(const DeviceOptions& options, int width,
                                     int height)
    : state_(std::make_unique<State>(options, Extent(width, height))) {}

OffscreenRenderer::~OffscreenRenderer() = default;

Image OffscreenRenderer::Render(const Picture& picture,
                                const std::function<void()>& draw_ui) {
  State& state = *state_;
  state.gui.Build(draw_ui, state.target.extent());
  state.slot.Wait();
  state.slot.Record(picture, state.passes, state.target, &state.drawer, &state.gui);
  state.slot.Submit(VK_NULL_HANDLE, VK_NULL_HANDLE);
  return state.target.Read(state.device);
}

const DeviceDescription& OffscreenRenderer::device() const {
  return state_->device.description();
}

int OffscreenRenderer::samples() const { return state_->passes.samples(); }

}  // namespace dpe::viewer
