// The picture never waits for the simulation, with a cloth of 96 x 96 vertices: counts
// and ratios of what one run does, no seconds.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include "app/session.h"
#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/simulator.h"
#include "render/offscreen_renderer.h"
#include "support/sanitizers.h"

namespace dpe::viewer {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kPatience{120};

#ifdef DPE_TEST_SANITIZED
constexpr int kSide = 24;  // a sanitizer makes a cloth heavy enough
#else
constexpr int kSide = 96;
#endif

Scene Cloth() {
  PresetOptions preset;
  preset.rows = preset.cols = kSide;
  return MakePresetScene(ScenePreset::kSide, preset);
}

double SecondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

class NeverWaitsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (ListDevices().empty()) GTEST_SKIP() << "there is no Vulkan device";
    renderer_ = std::make_unique<OffscreenRenderer>(DeviceOptions{}, 160, 120);
  }

  static std::unique_ptr<Session> MakeSession(Scene scene,
                                              std::function<void()> on_frame = {}) {
    PlayerSources sources;
    sources.scene = std::move(scene);
    sources.on_frame = std::move(on_frame);
    return std::make_unique<Session>(std::move(sources), Deviations{}, ViewOptions{});
  }

  // As the window does it, once.
  Image ShowNow(Session* session) {
    session->Update(0.0);
    session->Orbit(3.0, 1.0, 120.0);
    return renderer_->Render(session->MakePicture(160, 120));
  }

  // Until a frame is there; false if it never comes.
  static bool WaitForFrame(Session* session, int frame) {
    const Clock::time_point begin = Clock::now();
    while (session->player().frame() < frame) {
      if (Clock::now() - begin > kPatience) return false;
      session->Update(0.0);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
  }

  std::unique_ptr<OffscreenRenderer> renderer_;
};

TEST_F(NeverWaitsTest, PicturesAreDrawnWhileTheSimulationStandsStill) {
  std::mutex gate;
  std::atomic<bool> closed{false}, stands{false};
  const auto session = MakeSession(Cloth(), [&] {
    if (!closed) return;
    stands = true;
    const std::lock_guard<std::mutex> wait(gate);
  });
  std::unique_lock<std::mutex> close(gate);
  closed = true;
  session->player().SetPaused(false);
  const Clock::time_point begin = Clock::now();
  while (!stands && Clock::now() - begin < kPatience) std::this_thread::yield();
  ASSERT_TRUE(stands);
  auto drawing = std::async(std::launch::async, [&] {
    int changes = 0;
    Image last = ShowNow(session.get());
    for (int picture = 0; picture < 10; ++picture) {
      Image image = ShowNow(session.get());
      changes += image.rgba != last.rgba;
      last = std::move(image);
    }
    return changes;
  });
  const bool done = drawing.wait_for(kPatience) == std::future_status::ready;
  EXPECT_TRUE(done) << "the picture waits for the simulation";
  closed = false;
  close.unlock();
  EXPECT_EQ(drawing.get(), 10);  // each from another side
}

TEST_F(NeverWaitsTest, ManyPicturesAreDrawnDuringALongStep) {
  constexpr int kMany = 15, kFew = 3;
  Scene scene = Cloth();
  double seconds_per_picture = 0.0, seconds_per_step = 0.0;
  {
    const auto session = MakeSession(scene);
    ShowNow(session.get());
    const Clock::time_point begin = Clock::now();
    for (int k = 0; k < 5; ++k) ShowNow(session.get());
    seconds_per_picture = SecondsSince(begin) / 5;
    session->player().StepForward();
    ASSERT_TRUE(WaitForFrame(session.get(), 1));
    seconds_per_step = 1e-3 * session->player().frame_ms();
  }
  // A frame that takes as long as many pictures ...
  scene.steps_per_frame = static_cast<int>(
      std::clamp(kMany * seconds_per_picture / seconds_per_step, 1.0, 1000.0) + 1.0);
  const auto session = MakeSession(scene);
  session->player().SetPaused(false);
  ASSERT_TRUE(WaitForFrame(session.get(), 1));
  const int first = session->player().frame();
  int pictures = 0;
  while (session->player().frame() < first + 2) {
    ShowNow(session.get());
    ++pictures;
  }
  // ... does not keep those from being drawn. Waiting for it would make it one for
  // each.
  EXPECT_GE(pictures, 2 * kFew) << scene.steps_per_frame << " steps per frame";
}

TEST_F(NeverWaitsTest, EveryFrameThatIsShownIsWhole) {
  constexpr int kFrames = 12;
  const Scene scene = Cloth();
  const Trajectory trajectory = Simulator(scene).Simulate(kFrames);
  const auto session = MakeSession(scene);
  session->player().SetPaused(false);
  int shown = 0, last = -1;
  const Clock::time_point begin = Clock::now();
  while (last < kFrames - 2 && Clock::now() - begin < kPatience) {
    session->Update(0.0);
    const int frame = session->player().frame();
    const Picture picture = session->MakePicture(160, 120);
    if (frame == last || frame >= kFrames) {
      last = std::max(last, frame);
      continue;
    }
    ++shown;
    last = frame;
    const Eigen::VectorXd x = trajectory.positions[0].col(frame);
    ASSERT_EQ(session->player().motion().positions[0], x) << "frame " << frame;
    ASSERT_EQ(picture.surfaces[0].positions, ToPoints(x)) << "frame " << frame;
  }
  EXPECT_GE(shown, 3);
}

}  // namespace
}  // namespace dpe::viewer
