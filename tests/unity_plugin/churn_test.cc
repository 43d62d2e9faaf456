// Scenes are started, paused, stopped, changed and destroyed by several threads at
// random, while others read their positions: no call may hang or crash, and whatever is
// read must be one whole state. Under the sanitizers: no race, no leak.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <random>
#include <thread>

#include "c_api_support.h"
#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/scene_io.h"

namespace dpe::test {
namespace {

class Churn {
 public:
  Churn() {
    PresetOptions options;
    options.rows = options.cols = 6;
    const Scene scene = MakePresetScene(ScenePreset::kSide, options);
    json_ = SceneToJson(scene);
    num_vertices_ = scene.objects[0].num_vertices();
    for (unsigned slot = 0; slot < scenes_.size(); ++slot) Create(slot);
  }

  void Run(double seconds) {
    const auto end = std::chrono::steady_clock::now() +
                     std::chrono::duration_cast<std::chrono::nanoseconds>(
                         std::chrono::duration<double>(seconds));
    std::vector<std::thread> threads;
    for (unsigned seed = 1; seed <= 3; ++seed) {
      threads.emplace_back([=] { Act(seed, end); });
    }
    threads.emplace_back([=] { Watch(end); });
    for (std::thread& thread : threads) thread.join();
    EXPECT_DPE_OK(dpe_shutdown());
    EXPECT_EQ(dpe_live_handles(), 0);
    EXPECT_EQ(failures_, 0);
    EXPECT_GT(num_created_, scenes_.size());
    EXPECT_GT(num_states_, 10);
  }

 private:
  using Time = std::chrono::steady_clock::time_point;

  void Create(unsigned slot) {
    dpe_scene scene = 0;
    Expect(dpe_scene_create_from_json(DPE_C_VERSION, json_.c_str(), &scene));
    ++num_created_;
    // Whoever takes a scene's place destroys it.
    const dpe_scene before = scenes_[slot].exchange(scene);
    if (before != 0) Expect(dpe_scene_destroy(before));
  }

  // Handles may be destroyed by another thread at any time.
  void Expect(dpe_status status) {
    if (status != DPE_OK && status != DPE_ERROR_HANDLE && status != DPE_ERROR_STATE) {
      ++failures_;
      ADD_FAILURE() << dpe_status_name(status) << " " << LastError();
    }
  }

  void Act(unsigned seed, Time end) {
    std::mt19937 random(seed);
    while (std::chrono::steady_clock::now() < end) {
      const unsigned slot = random() % scenes_.size();
      const dpe_scene scene = scenes_[slot];
      ActOn(scene, slot, &random);
      std::this_thread::sleep_for(std::chrono::microseconds(random() % 3000));
    }
  }

  void ActOn(dpe_scene scene, unsigned slot, std::mt19937* random) {
    const double stiffness[] = {10.0 + (*random)() % 50};
    const double rates[] = {1.0, 4.0, 0.0};
    switch ((*random)() % 10) {
      case 0:
        return Create(slot);
      case 1:
        return Expect(dpe_scene_stop(scene));
      case 2:
        return Expect(dpe_scene_pause(scene));
      case 3:
        return Expect(dpe_scene_step(scene, 2));
      case 4:
        return Expect(dpe_scene_set_rate(scene, rates[(*random)() % 3]));
      case 5:
        return Expect(dpe_scene_set_parameter(scene, 0, DPE_STIFFNESS, stiffness, 1));
      case 6:
        return Expect(dpe_scene_set_fixed(scene, 0, (*random)() % 6, (*random)() % 2));
      default:
        return Expect(dpe_scene_start(scene));
    }
  }

  // Reads positions without pause; they are those of a cloth that hangs together.
  void Watch(Time end) {
    std::array<ReadPositions, kScenes> last;
    while (std::chrono::steady_clock::now() < end) {
      for (unsigned slot = 0; slot < kScenes; ++slot) {
        ReadPositions read;
        read.positions.resize(3 * num_vertices_);
        Expect(
            dpe_scene_copy_positions(scenes_[slot], 0, read.positions.data(),
                                     static_cast<std::int32_t>(read.positions.size()),
                                     &read.sequence, &read.frame, &read.is_new));
        if (read.is_new == 0) continue;
        num_states_ += read.sequence != last[slot].sequence;
        for (float x : read.positions) failures_ += !(std::abs(x) < 1e3f);
        last[slot] = std::move(read);
      }
      std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
  }

  static constexpr unsigned kScenes = 3;
  std::string json_;
  int num_vertices_ = 0;
  std::array<std::atomic<dpe_scene>, kScenes> scenes_{};
  std::atomic<int> failures_{0};
  std::atomic<unsigned> num_created_{0};
  std::atomic<long> num_states_{0};
};

TEST(ChurnTest, ThreadsMayDoAnythingAtAnyTime) { Churn().Run(10.0); }

TEST(ChurnTest, LongThreadsMayDoAnythingAtAnyTime) { Churn().Run(600.0); }

}  // namespace
}  // namespace dpe::test
