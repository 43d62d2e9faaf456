#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

#include "c_api_support.h"
#include "dpe/engine/scene_io.h"
#include "dpe/estimation/estimation_job.h"
#include "support/temp_dir.h"
#include "support/test_scenes.h"

namespace dpe::test {
namespace {

using ::testing::HasSubstr;

class EstimationApiTest : public ::testing::Test {
 protected:
  EstimationApiTest() {
    given_.num_frames = 20;
    ApplySettings("nL", &given_);
    SaveScene(given_, path_);
    EXPECT_DPE_OK(dpe_estimation_create(DPE_C_VERSION, &estimation_));
    Set("scene", path_);
    // The answer is not to be the start.
    Set("init", "scene");
    EXPECT_DPE_OK(dpe_estimation_set_number(estimation_, "noise_sigma", 1e-3));
  }

  void Set(const char* name, const std::string& value) {
    EXPECT_DPE_OK(dpe_estimation_set_text(estimation_, name, value.c_str()));
  }

  std::int32_t State(double seconds = 0.0) {
    std::int32_t state = -1;
    EXPECT_DPE_OK(dpe_estimation_wait(estimation_, seconds, &state));
    return state;
  }

  const TempDir folder_;
  const std::string path_ = folder_.File("scene.txt");
  Scene given_ = MakeDerivativeScene("side", 5);
  OwnedHandle estimation_{dpe_estimation_destroy};
};

struct Calls {
  std::atomic<int> count{0};
  std::atomic<dpe_estimation> cancel{0}, destroy{0};
  double last_fraction = 0.0;
  bool is_growing = true;
};

void OnProgress(void* user, const dpe_progress* progress) {
  auto* calls = static_cast<Calls*>(user);
  calls->is_growing &= progress->fraction >= calls->last_fraction;
  calls->last_fraction = progress->fraction;
  ++calls->count;
  if (calls->cancel != 0) dpe_estimation_cancel(calls->cancel);
  if (calls->destroy != 0) dpe_estimation_destroy(calls->destroy.exchange(0));
}

TEST_F(EstimationApiTest, FindsWhatTheEstimatorFinds) {
  Calls calls;
  ASSERT_DPE_OK(dpe_estimation_set_callback(estimation_, OnProgress, &calls));
  Set("output_dir", folder_.File("out"));
  Set("settings", "nG");
  Set("estimate", "damping");
  EXPECT_EQ(State(), DPE_ESTIMATION_IDLE);
  ASSERT_DPE_OK(dpe_estimation_start(estimation_));
  ASSERT_EQ(State(600.0), DPE_ESTIMATION_DONE) << LastError(estimation_);
  EXPECT_GT(calls.count, 1);
  EXPECT_TRUE(calls.is_growing);
  std::int32_t state = 0;
  dpe_progress progress;
  ASSERT_DPE_OK(dpe_estimation_poll(estimation_, &state, &progress));
  EXPECT_EQ(progress.fraction, 1.0);

  EstimationJob job;
  job.scene_paths = {path_};
  job.noise_sigma = 1e-3;
  job.settings = "nG";
  job.estimate = {"damping"};
  job.options.init = InitMethod::kScene;
  EstimationInput input = LoadEstimationInput(job);
  const EstimatorSummary expected = RunEstimation(job.options, {}, &input, nullptr);
  dpe_result result;
  ASSERT_DPE_OK(dpe_estimation_get_result(estimation_, &result));
  EXPECT_EQ(result.final_rms, expected.final_rms);
  EXPECT_EQ(result.iterations, expected.iterations);
  EXPECT_EQ(result.num_parameters, expected.parameters.size());
  EXPECT_EQ(result.deviation_percent,
            ParameterDeviationPercent(expected, input.scenes()));
  EXPECT_LT(result.deviation_percent, 10.0);
  dpe_block block;
  ASSERT_DPE_OK(dpe_estimation_get_block(estimation_, 0, &block));
  EXPECT_EQ(block.kind, DPE_STIFFNESS);
  EXPECT_EQ(block.mode, 'G');
  ASSERT_EQ(block.num_values, 1);
  double value = 0.0, error = 0.0;
  ASSERT_DPE_OK(dpe_estimation_get_values(estimation_, 0, &value, 1, nullptr));
  EXPECT_EQ(value, expected.blocks[0].values[0]);
  ASSERT_EQ(block.has_errors, 1);
  ASSERT_DPE_OK(dpe_estimation_get_errors(estimation_, 0, &error, 1, nullptr));
  EXPECT_EQ(error, expected.uncertainty.blocks[0].standard_deviations[0]);
  EXPECT_NEAR(value, given_.objects[0].stiffness.mean(), 0.1 * value);
  ASSERT_DPE_OK(dpe_estimation_get_block(estimation_, 1, &block));
  EXPECT_EQ(block.kind, DPE_DAMPING);

  OwnedScene fitted;
  ASSERT_DPE_OK(dpe_estimation_create_scene(estimation_, &fitted));
  const int num_springs = given_.objects[0].num_springs();
  std::vector<double> stiffness(num_springs);
  ASSERT_DPE_OK(dpe_scene_get_parameter(fitted, 0, DPE_STIFFNESS, stiffness.data(),
                                        num_springs, nullptr));
  EXPECT_EQ(stiffness[0], value);
  std::vector<char> files(4096);
  ASSERT_DPE_OK(dpe_estimation_get_files(estimation_, files.data(), 4096, nullptr));
  const std::string text = files.data();
  const Scene written = LoadScene(text.substr(0, text.find('\n')));
  EXPECT_EQ(written.objects[0].stiffness[0], value);
}

TEST_F(EstimationApiTest, CancelStopsItWithTheBestSoFar) {
  Calls calls;
  calls.cancel = estimation_;
  ASSERT_DPE_OK(dpe_estimation_set_callback(estimation_, OnProgress, &calls));
  ASSERT_DPE_OK(dpe_estimation_start(estimation_));
  EXPECT_EQ(State(600.0), DPE_ESTIMATION_CANCELLED);
  EXPECT_LE(calls.count, 3);
  dpe_result result;
  ASSERT_DPE_OK(dpe_estimation_get_result(estimation_, &result));
  EXPECT_EQ(result.termination, DPE_INTERRUPTED);
  EXPECT_EQ(dpe_estimation_start(estimation_), DPE_ERROR_STATE);
}

TEST_F(EstimationApiTest, MayBeDestroyedByItsOwnCallback) {
  Calls calls;
  calls.destroy = estimation_;
  ASSERT_DPE_OK(dpe_estimation_set_callback(estimation_, OnProgress, &calls));
  ASSERT_DPE_OK(dpe_estimation_start(estimation_));
  while (dpe_live_handles() > 0) std::this_thread::yield();
  std::int32_t state = 0;
  EXPECT_EQ(dpe_estimation_poll(estimation_, &state, nullptr), DPE_ERROR_HANDLE);
  // Its thread goes on for a moment; it must find `calls`, then nothing more.
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(calls.count, 1);
}

TEST_F(EstimationApiTest, IsDestroyedWhileItRuns) {
  for (int wait_ms : {0, 1, 5, 20}) {
    dpe_estimation estimation = 0;
    ASSERT_DPE_OK(dpe_estimation_create(DPE_C_VERSION, &estimation));
    ASSERT_DPE_OK(dpe_estimation_set_text(estimation, "scene", path_.c_str()));
    ASSERT_DPE_OK(dpe_estimation_start(estimation));
    std::thread waiter([&] {
      std::int32_t state = 0;
      dpe_estimation_wait(estimation, 1000.0, &state);
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
    ASSERT_DPE_OK(dpe_estimation_destroy(estimation));
    waiter.join();
  }
}

TEST_F(EstimationApiTest, SaysWhatIsWrong) {
  EXPECT_EQ(dpe_estimation_set_text(estimation_, "colour", "red"), DPE_ERROR_ARGUMENT);
  EXPECT_THAT(LastError(estimation_), HasSubstr("accepted are"));
  EXPECT_EQ(dpe_estimation_set_text(estimation_, "solver", "magic"), DPE_ERROR_INPUT);
  EXPECT_EQ(dpe_estimation_set_number(estimation_, "frames", 2.5), DPE_ERROR_ARGUMENT);
  EXPECT_EQ(dpe_estimation_set_number(estimation_, "threads", 0), DPE_ERROR_ARGUMENT);
  EXPECT_EQ(dpe_estimation_set_number(estimation_, "sigma", std::nan("")),
            DPE_ERROR_ARGUMENT);
  dpe_result result;
  EXPECT_EQ(dpe_estimation_get_result(estimation_, &result), DPE_ERROR_STATE);
  Set("target", "nowhere.csv");
  ASSERT_DPE_OK(dpe_estimation_start(estimation_));
  EXPECT_EQ(State(600.0), DPE_ESTIMATION_FAILED);
  EXPECT_THAT(LastError(estimation_), HasSubstr("nowhere.csv"));
  EXPECT_EQ(dpe_estimation_get_result(estimation_, &result), DPE_ERROR_STATE);
  EXPECT_EQ(dpe_estimation_set_text(estimation_, "target", ""), DPE_ERROR_STATE);
  OwnedHandle empty{dpe_estimation_destroy};
  ASSERT_DPE_OK(dpe_estimation_create(DPE_C_VERSION, &empty));
  EXPECT_EQ(dpe_estimation_start(empty), DPE_ERROR_ARGUMENT) << "no scene";
}

}  // namespace
}  // namespace dpe::test
