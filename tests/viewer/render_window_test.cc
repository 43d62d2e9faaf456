// Windows, in a virtual display.
#include <GLFW/glfw3.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include <chrono>
#include <thread>

#include "cloth_picture.h"
#include "picture_difference.h"
#include "render/offscreen_renderer.h"
#include "render/window_renderer.h"
#include "validated.h"
#include "virtual_display.h"
#include "vk/vulkan_error.h"

namespace dpe::viewer {
namespace {

class WindowRendererTest : public ValidatedTest {
 protected:
  void SetUp() override {
    if (!display_.runs()) GTEST_SKIP() << "Xvfb was not found";
    ASSERT_TRUE(glfwInit());
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    window_ = glfwCreateWindow(320, 240, "test", nullptr, nullptr);
    ASSERT_NE(window_, nullptr);
    WaitForSize(320, 240);
  }
  ~WindowRendererTest() override {
    if (window_ != nullptr) glfwDestroyWindow(window_);
    glfwTerminate();
  }

  // The X server tells of changes when it likes to.
  void WaitForSize(int width, int height) {
    for (int attempt = 0; attempt < 500; ++attempt) {
      glfwPollEvents();
      int now[2];
      glfwGetFramebufferSize(window_, &now[0], &now[1]);
      if (now[0] == width && now[1] == height) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    FAIL() << "the window did not become " << width << " by " << height;
  }
  void Resize(int width, int height) {
    glfwSetWindowSize(window_, width, height);
    WaitForSize(width, height);
  }
  Image Offscreen(const Picture& picture, int width, int height) {
    return OffscreenRenderer(options_, width, height).Render(picture);
  }

  VirtualDisplay display_;
  GLFWwindow* window_ = nullptr;
};

TEST_F(WindowRendererTest, ShowsWhatOffscreenDraws) {
  WindowRenderer renderer(window_, options_);
  EXPECT_EQ(renderer.Capture().width, 0);
  const Picture picture = ClothPicture(16, 4.0f / 3);
  for (int frame = 0; frame < 5; ++frame) EXPECT_TRUE(renderer.Draw(picture));
  const Image image = renderer.Capture();
  ASSERT_EQ(image.width, 320);
  ASSERT_EQ(image.height, 240);
  EXPECT_EQ(image.rgba, Offscreen(picture, 320, 240).rgba);
}

TEST_F(WindowRendererTest, ADraftHasOneSamplePerPixel) {
  WindowRenderer renderer(window_, options_);
  if (renderer.samples() == 1) GTEST_SKIP() << "the device has one sample per pixel";
  const Picture picture = ClothPicture(16, 4.0f / 3);
  const Image full = Offscreen(picture, 320, 240);
  options_.samples = 1;
  const Image draft = Offscreen(picture, 320, 240);
  EXPECT_NE(draft.rgba, full.rgba);
  EXPECT_LT(Compare(draft, full).mean, 2.3) << "which is just noticed";
  for (const bool is_draft : {true, false, false, true, true, false}) {
    EXPECT_TRUE(renderer.Draw(picture, {}, is_draft));
    EXPECT_EQ(renderer.Capture().rgba, is_draft ? draft.rgba : full.rgba);
  }
  Resize(200, 100);
  const Picture wide = ClothPicture(16, 2.0f);
  EXPECT_TRUE(renderer.Draw(wide, {}, true));
  EXPECT_EQ(renderer.Capture().rgba, Offscreen(wide, 200, 100).rgba);
}

TEST_F(WindowRendererTest, FollowsTheWindowsSize) {
  WindowRenderer renderer(window_, options_);
  const int sizes[][2] = {{320, 240}, {500, 200}, {64, 400}, {800, 600}, {320, 240}};
  for (const auto& size : sizes) {
    Resize(size[0], size[1]);
    const Picture picture = ClothPicture(16, float(size[0]) / size[1]);
    EXPECT_TRUE(renderer.Draw(picture));
    EXPECT_TRUE(renderer.Draw(picture));
    const Image image = renderer.Capture();
    ASSERT_EQ(image.width, size[0]);
    ASSERT_EQ(image.height, size[1]);
    EXPECT_EQ(image.rgba, Offscreen(picture, size[0], size[1]).rgba);
  }
}

// As when an edge is dragged: sizes change between asking and drawing.
TEST_F(WindowRendererTest, KeepsUpWithSizesThatKeepChanging) {
  WindowRenderer renderer(window_, options_);
  const Picture picture = ClothPicture(8, 1.0f);
  for (int step = 0; step < 40; ++step) {
    glfwSetWindowSize(window_, 200 + 7 * step, 150 + 5 * ((step * 3) % 17));
    glfwPollEvents();
    renderer.Draw(picture);
  }
  Resize(123, 77);
  EXPECT_TRUE(renderer.Draw(picture));
  EXPECT_EQ(renderer.Capture().width, 123);
}

TEST_F(WindowRendererTest, TheInterfaceIsOnTop) {
  WindowRenderer renderer(window_, options_);
  EXPECT_TRUE(renderer.Draw(ClothPicture(8, 4.0f / 3), [] {
    ImGui::GetForegroundDrawList()->AddRectFilled({0, 0}, {320, 240},
                                                  IM_COL32(10, 128, 250, 255));
  }));
  const Image image = renderer.Capture();
  EXPECT_EQ(image.Pixel(160, 120)[0], 10);
  EXPECT_EQ(image.Pixel(160, 120)[1], 128);
  EXPECT_EQ(image.Pixel(160, 120)[2], 250);
}

TEST_F(WindowRendererTest, ALostDeviceIsReplaced) {
  WindowRenderer renderer(window_, options_);
  const Picture picture = ClothPicture(16, 4.0f / 3);
  const auto draw_ui = [] { ImGui::ShowMetricsWindow(); };
  EXPECT_TRUE(renderer.Draw(picture, draw_ui));
  for (int loss = 1; loss <= 3; ++loss) {
    renderer.LoseDevice();
    EXPECT_TRUE(renderer.Draw(picture, draw_ui));
    EXPECT_EQ(renderer.devices_lost(), loss);
  }
  EXPECT_TRUE(renderer.Draw(picture));
  EXPECT_EQ(renderer.Capture().rgba, Offscreen(picture, 320, 240).rgba);
}

TEST_F(WindowRendererTest, ADeviceThatIsLostAgainAtOnceIsGivenUp) {
  WindowRenderer renderer(window_, options_);
  renderer.LoseDevice(2);
  EXPECT_THROW(renderer.Draw(ClothPicture(8, 1.0f)), DeviceLostError);
}

TEST_F(WindowRendererTest, WindowsOfAnotherGraphicsLibraryAreRefused) {
  // What GLFW says if the window was made for OpenGL (or has none of our hints).
  glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
  GLFWwindow* other = glfwCreateWindow(64, 64, "other", nullptr, nullptr);
  if (other == nullptr) GTEST_SKIP() << "no OpenGL here";
  EXPECT_THROW(WindowRenderer(other, options_), VulkanError);
  glfwDestroyWindow(other);
}

}  // namespace
}  // namespace dpe::viewer
