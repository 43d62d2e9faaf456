// How long a frame takes. No limit in seconds: machines differ. What must hold
// everywhere is that it grows no faster than the cloth.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>

#include "cloth_picture.h"
#include "render/offscreen_renderer.h"
#include "render/window_renderer.h"
#include "virtual_display.h"

namespace dpe::viewer {
namespace {

constexpr int kWidth = 1280;
constexpr int kHeight = 720;

Picture Cloth(int side, bool with_edges) {
  Picture picture = ClothPicture(side, float{kWidth} / kHeight);
  if (!with_edges) picture.lines[1] = {};
  return picture;
}

double Now(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return now.tv_sec + 1e-9 * now.tv_nsec;
}

struct Times {
  double wall = 1e9;       // s per frame
  double processor = 1e9;  // s per frame, all threads
};

// The best of some runs of a few frames each.
Times Measure(const std::function<void()>& draw) {
  constexpr int kFrames = 5;
  Times best;
  for (int i = 0; i < 3; ++i) draw();
  for (int run = 0; run < 3; ++run) {
    const double wall = Now(CLOCK_MONOTONIC);
    const double processor = Now(CLOCK_PROCESS_CPUTIME_ID);
    for (int i = 0; i < kFrames; ++i) draw();
    best.wall = std::min(best.wall, (Now(CLOCK_MONOTONIC) - wall) / kFrames);
    best.processor =
        std::min(best.processor, (Now(CLOCK_PROCESS_CPUTIME_ID) - processor) / kFrames);
  }
  return best;
}

void Print(const char* what, int side, bool with_edges, const Times& times) {
  std::printf("%s, %d x %d, %s: %.1f ms, %.1f ms of processors\n", what, side, side,
              with_edges ? "with edges" : "surface", 1e3 * times.wall,
              1e3 * times.processor);
}

// A new picture each time, as a moving cloth makes one, of the same topology.
Times MeasureOffscreen(int side, bool with_edges) {
  OffscreenRenderer renderer({}, kWidth, kHeight);
  const Picture picture = Cloth(side, with_edges);
  const Times times = Measure([&] { renderer.Render(picture); });
  Print("memory", side, with_edges, times);
  return times;
}

TEST(RenderSpeedLongTest, TimeGrowsNoFasterThanTheCloth) {
  for (const bool with_edges : {false, true}) {
    const Times small = MeasureOffscreen(96, with_edges);
    const Times large = MeasureOffscreen(192, with_edges);
    EXPECT_LT(large.processor, 6 * small.processor) << "for four times the vertices";
  }
}

TEST(RenderSpeedLongTest, Window) {
  const VirtualDisplay display;
  if (!display.runs()) GTEST_SKIP() << "Xvfb was not found";
  ASSERT_TRUE(glfwInit());
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  GLFWwindow* window = glfwCreateWindow(kWidth, kHeight, "test", nullptr, nullptr);
  ASSERT_NE(window, nullptr);
  {
    WindowRenderer renderer(window, {});
    for (const bool with_edges : {false, true}) {
      Times times[2];
      for (const int large : {0, 1}) {
        const Picture picture = Cloth(large ? 192 : 96, with_edges);
        times[large] = Measure([&] {
          glfwPollEvents();
          renderer.Draw(picture);
        });
        Print("window", large ? 192 : 96, with_edges, times[large]);
      }
      EXPECT_LT(times[1].processor, 6 * times[0].processor);
    }
  }
  glfwDestroyWindow(window);
  glfwTerminate();
}

}  // namespace
}  // namespace dpe::viewer
