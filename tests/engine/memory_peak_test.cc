// How much memory is resident at once while large gradients are computed, each in a
// process of its own.
//
// Sanitizers take memory of their own: there is nothing to measure under them.
#include "support/sanitizers.h"

#ifndef DPE_TEST_SANITIZED

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstddef>
#include <vector>

#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/sensitivity.h"
#include "dpe/engine/simulator.h"

namespace dpe::test {
namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20;

struct Case {
  int grid;
  int num_frames;
  int steps_per_frame;
  IntegrationMethod method;
};

// Of L = 1/2 sum |x|^2 over all frames; empty after a failure.
Eigen::VectorXd Gradient(const Case& c, std::size_t limit) {
  PresetOptions preset;
  preset.rows = preset.cols = c.grid;
  Scene scene = MakePresetScene(ScenePreset::kSide, preset);
  scene.integration_method = c.method;
  scene.steps_per_frame = c.steps_per_frame;
  SimulatorOptions options;
  options.memory_limit_bytes = limit;
  options.newton_tolerance = 1e-11;
  Simulator simulator(scene, options);
  const Rollout rollout =
      simulator.Run(simulator.layout().Extract(scene), c.num_frames);
  if (!rollout.status().ok()) return {};
  Sensitivity sensitivity(&simulator, &rollout);
  const Eigen::VectorXd gradient = sensitivity.Gradient(rollout.trajectory().positions);
  return sensitivity.ok() ? gradient : Eigen::VectorXd();
}

// Computes the gradient in a child process, whose peak is returned.
Eigen::VectorXd GradientInChild(const Case& c, std::size_t limit, double* peak_mib) {
  int ends[2];
  if (pipe(ends) != 0) return {};
  const pid_t child = fork();
  if (child == 0) {
    const Eigen::VectorXd gradient = Gradient(c, limit);
    const char* data = reinterpret_cast<const char*>(gradient.data());
    const std::size_t size = gradient.size() * sizeof(double);
    for (std::size_t done = 0; done < size;) {
      const ssize_t count = write(ends[1], data + done, size - done);
      if (count <= 0) _exit(1);
      done += count;
    }
    _exit(0);
  }
  close(ends[1]);
  std::vector<char> bytes;
  char buffer[4096];
  for (ssize_t count; (count = read(ends[0], buffer, sizeof(buffer))) > 0;) {
    bytes.insert(bytes.end(), buffer, buffer + count);
  }
  close(ends[0]);
  int status = 0;
  rusage usage = {};
  wait4(child, &status, 0, &usage);
  *peak_mib = static_cast<double>(usage.ru_maxrss) / 1024.0;
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  return Eigen::Map<const Eigen::VectorXd>(
      reinterpret_cast<const double*>(bytes.data()), bytes.size() / sizeof(double));
}

// @param limited  what must suffice, MiB, where a rollout may keep `limit`
void ExpectSameGradientWithin(const Case& c, std::size_t limit, double limited) {
  double peak = 0.0, peak_without_limit = 0.0;
  const Eigen::VectorXd gradient = GradientInChild(c, limit, &peak);
  const Eigen::VectorXd expected =
      GradientInChild(c, std::size_t{1} << 40, &peak_without_limit);
  testing::Test::RecordProperty("peak_mib", std::to_string(peak));
  testing::Test::RecordProperty("unlimited_mib", std::to_string(peak_without_limit));
  ASSERT_GT(expected.size(), 0);
  ASSERT_EQ(gradient.size(), expected.size());
  EXPECT_LE((gradient - expected).norm(), 1e-12 * expected.norm());
  EXPECT_LT(peak, limited);
}

constexpr IntegrationMethod kLinearlyImplicit =
    IntegrationMethod::kLinearlyImplicitEuler;

// 48 x 48 vertices, 60 steps: 570 MiB of factorisations without a limit.
TEST(MemoryPeakTest, FactorizationsStayBelowTheLimit) {
  ExpectSameGradientWithin({48, 61, 1, kLinearlyImplicit}, 100 * kMiB, 200.0);
}

TEST(MemoryPeakTest, StagesStayBelowTheLimit) {
  ExpectSameGradientWithin({32, 201, 2, IntegrationMethod::kTrBdf2}, 10 * kMiB, 80.0);
}

// Steps of delta are too long for cloths so fine (linearly_implicit_euler.h): with 4 to
// a frame at 96 x 96 vertices, and 16 at 192 x 192, energy never rises. The states
// between the frames take 632 MiB without a limit.
TEST(MemoryPeakLongTest, FiveHundredFramesOfNineThousandVertices) {
  ExpectSameGradientWithin({96, 500, 4, kLinearlyImplicit}, 512 * kMiB, 1024.0);
}

TEST(MemoryPeakLongTest, SubstepsOfNineThousandVertices) {
  // The trajectory and dL/dx take 66 MiB, the states between 190 without a limit.
  ExpectSameGradientWithin({96, 101, 10, kLinearlyImplicit}, 32 * kMiB, 180.0);
}

TEST(MemoryPeakLongTest, AHundredFramesOfThirtySevenThousandVertices) {
  double peak = 0.0;
  const Eigen::VectorXd gradient = GradientInChild(
      {192, 100, 16, kLinearlyImplicit}, SimulatorOptions().memory_limit_bytes, &peak);
  RecordProperty("peak_mib", std::to_string(peak));
  EXPECT_GT(gradient.norm(), 0.0);
  EXPECT_LT(peak, 4096.0);
}

}  // namespace
}  // namespace dpe::test

#endif
