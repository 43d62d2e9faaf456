#include "playback/live_source.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/simulator.h"
#include "support/sanitizers.h"
#include "support/test_scenes.h"

namespace dpe::viewer {
namespace {

constexpr double kPatience = 60.0;  // s, before a test gives up

// Polls until `done`, as a display does.
template <class Done>
bool WaitUntil(LiveSource* source, const Done& done) {
  const auto start = std::chrono::steady_clock::now();
  while (!done(source->frame())) {
    source->Update();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const std::chrono::duration<double> waited =
        std::chrono::steady_clock::now() - start;
    if (waited.count() > kPatience) return false;
  }
  return true;
}

LiveControls ControlsOf(const Scene& scene) {
  LiveControls controls;
  controls.tuning = TuningOf(scene);
  return controls;
}

TEST(LiveSourceTest, StepsAreTheFramesOfSimulate) {
  const Scene scene = test::MakeDerivativeScene("two_objects", 6);
  const Trajectory trajectory = Simulator(scene).Simulate(8);
  std::atomic<int> calls{0};
  LiveSource source({scene}, [&] { ++calls; });
  LiveControls controls = ControlsOf(scene);
  ASSERT_TRUE(source.Update());
  EXPECT_EQ(source.frame().frame, 0);
  EXPECT_EQ(source.frame().motions[0].positions[1], trajectory.positions[1].col(0));
  for (int f = 1; f < 8; ++f) {
    controls.steps = f;
    source.Set(controls);
    ASSERT_TRUE(
        WaitUntil(&source, [f](const LiveFrame& now) { return now.steps == f; }));
    EXPECT_EQ(source.frame().frame, f);
    for (int o = 0; o < 2; ++o) {
      EXPECT_EQ(source.frame().motions[0].positions[o], trajectory.positions[o].col(f));
      EXPECT_EQ(source.frame().motions[0].velocities[o],
                trajectory.velocities[o].col(f));
    }
  }
  EXPECT_GT(source.frame().frame_ms, 0.0);
  controls.restarts = 1;
  source.Set(controls);
  ASSERT_TRUE(WaitUntil(&source, [](const LiveFrame& f) { return f.restarts == 1; }));
  EXPECT_EQ(source.frame().frame, 0);
  EXPECT_EQ(source.frame().motions[0].positions[0], trajectory.positions[0].col(0));
  EXPECT_EQ(calls, 9);  // one for each frame that was published
}

TEST(LiveSourceTest, RunsInRealTimeAndStopsWhenPaused) {
  Scene scene = test::MakeDerivativeScene("side", 4);
  scene.delta = 0.004;
  LiveSource source({scene}, {});
  LiveControls controls = ControlsOf(scene);
  controls.paused = false;
  const auto start = std::chrono::steady_clock::now();
  source.Set(controls);
  ASSERT_TRUE(WaitUntil(&source, [](const LiveFrame& f) { return f.frame >= 50; }));
  const std::chrono::duration<double> elapsed =
      std::chrono::steady_clock::now() - start;
  // Never faster than time, but for the moment of delay that it may catch up.
  EXPECT_GE(elapsed.count(), 49 * scene.delta - 0.06);
  EXPECT_LT(source.frame().rate, 2.0);
  EXPECT_GT(source.frame().rate, 0.0);
  controls.paused = true;
  controls.steps = 1;  // is done after the pause has begun
  source.Set(controls);
  ASSERT_TRUE(WaitUntil(&source, [](const LiveFrame& f) { return f.steps == 1; }));
  const int frame = source.frame().frame;
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  source.Update();
  EXPECT_EQ(source.frame().frame, frame);
}

TEST(LiveSourceTest, AHeavySceneRunsSlowerAndNeverHoldsTheOtherSide) {
  // A frame of many steps takes far longer than its length.
  PresetOptions preset;
  preset.rows = preset.cols = 32;
  Scene scene = MakePresetScene(ScenePreset::kSide, preset);
  scene.delta = 0.001;
#ifdef DPE_TEST_SANITIZED
  scene.steps_per_frame = 4;  // each of which takes as long as ten
#else
  scene.steps_per_frame = 40;
#endif
  LiveSource source({scene}, {});
  LiveControls controls = ControlsOf(scene);
  controls.paused = false;
  source.Set(controls);
  ASSERT_TRUE(WaitUntil(&source, [](const LiveFrame& f) { return f.frame >= 2; }));
  // While a frame is simulated this side goes on: many turns for each new frame.
  const int first = source.frame().frame;
  long turns = 0;
  while (source.frame().frame < first + 3) {
    source.Set(controls);
    source.Update();
    ++turns;
  }
  EXPECT_GT(turns, 1000);
  EXPECT_LT(source.frame().rate, 0.5);
  EXPECT_GT(source.frame().frame_ms, 1e3 * scene.delta);
}

TEST(LiveSourceTest, TuningActsOnTheRunningSimulation) {
  Scene scene = test::MakeDerivativeScene("side", 5);
  scene.objects[0].drag_coefficient = 0.0;
  LiveSource source({scene}, {});
  LiveControls controls = ControlsOf(scene);
  Tuning& tuning = controls.tuning;
  tuning.objects[0] = {3.0, 0.5, 0.4, 0.2};
  tuning.wind = {4.0, 0.0, 1.0};
  controls.steps = 6;
  source.Set(controls);
  ASSERT_TRUE(WaitUntil(&source, [](const LiveFrame& f) { return f.steps == 6; }));
  const Trajectory expected = Simulator(TunedScene(scene, tuning)).Simulate(7);
  EXPECT_EQ(source.frame().motions[0].positions[0], expected.positions[0].col(6));
  const Trajectory untuned = Simulator(scene).Simulate(7);
  EXPECT_GT((untuned.positions[0].col(6) - expected.positions[0].col(6)).norm(), 1e-3);
}

TEST(LiveSourceTest, AFailureIsSaidAndANewTuningGoesOn) {
  Scene scene = test::MakeDerivativeScene("side", 5);
  scene.integration_method = IntegrationMethod::kExplicitEuler;
  LiveSource source({scene}, {});
  LiveControls controls = ControlsOf(scene);
  controls.tuning.objects[0].stiffness_factor = 1e12;
  controls.steps = 100;
  source.Set(controls);
  ASSERT_TRUE(WaitUntil(&source, [](const LiveFrame& f) { return f.steps == 100; }));
  EXPECT_NE(source.frame().failure.find("frame"), std::string::npos);
  EXPECT_TRUE(source.frame().motions[0].positions[0].allFinite());
  controls.tuning = TuningOf(scene);
  controls.restarts = 1;
  controls.steps = 103;
  source.Set(controls);
  ASSERT_TRUE(WaitUntil(&source, [](const LiveFrame& f) { return f.steps == 103; }));
  EXPECT_EQ(source.frame().failure, "");
  EXPECT_EQ(source.frame().frame, 3);
}

}  // namespace
}  // namespace dpe::viewer
