// After the first steps, steps allocate no memory of their own: not those of the
// explicit methods, not those with a linear system, whichever way it is solved, and not
// those of Newton's method.
//
// Counted by standing in for malloc and its kin, which sanitizers do themselves, and
// which needs glibc.
#include <gtest/gtest.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <tuple>
#include <vector>

#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/live_simulation.h"
#include "dpe/engine/simulator.h"
#include "support/sanitizers.h"

#if defined(__GLIBC__) && !defined(DPE_TEST_SANITIZED)

namespace {
thread_local long allocation_count = 0;
}  // namespace

extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* pointer, size_t size);
void* __libc_memalign(size_t alignment, size_t size);

void* malloc(size_t size) {
  ++allocation_count;
  return __libc_malloc(size);
}
void* calloc(size_t count, size_t size) {
  ++allocation_count;
  return __libc_calloc(count, size);
}
void* realloc(void* pointer, size_t size) {
  ++allocation_count;
  return __libc_realloc(pointer, size);
}
// What operator new calls for more than the usual alignment.
void* aligned_alloc(size_t alignment, size_t size) {
  ++allocation_count;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** pointer, size_t alignment, size_t size) {
  ++allocation_count;
  *pointer = __libc_memalign(alignment, size);
  return *pointer != nullptr ? 0 : ENOMEM;
}
}

namespace dpe::test {
namespace {

constexpr int kFrames = 20;
constexpr int kMoreFrames = 45;

// Allocations of the frames of a rollout beyond the first kFrames, of which there is
// one at least in each of them if steps allocate.
long AllocationsOfFurtherFrames(IntegrationMethod method, const std::string& solver) {
  Scene scene = MakePresetScene(ScenePreset::kFlag);
  scene.integration_method = method;
  scene.solver = solver;
  if (method == IntegrationMethod::kExplicitEuler ||
      method == IntegrationMethod::kSymplecticEuler) {
    scene.delta = 0.001;
  }
  Simulator simulator(scene);
  const auto count = [&](int num_frames) {
    const long before = allocation_count;
    const Trajectory trajectory = simulator.Simulate(num_frames);
    EXPECT_TRUE(trajectory.status.ok()) << trajectory.status.Message();
    return allocation_count - before;
  };
  count(kMoreFrames);
  return count(kMoreFrames) - count(kFrames);
}

TEST(AllocationTest, TheCounterCounts) {
  long before = allocation_count;
  const std::vector<double> vector(100);
  EXPECT_EQ(allocation_count, before + 1) << vector.size();
  struct alignas(64) Line {
    double values[8];
  };
  before = allocation_count;
  const std::vector<Line> lines(100);
  EXPECT_EQ(allocation_count, before + 1) << lines.size();
}

TEST(AllocationTest, ExplicitStepsAllocateNothing) {
  for (const IntegrationMethod method :
       {IntegrationMethod::kExplicitEuler, IntegrationMethod::kSymplecticEuler}) {
    EXPECT_EQ(AllocationsOfFurtherFrames(method, "auto"), 0)
        << IntegrationMethodName(method);
  }
}

class ImplicitAllocationTest
    : public testing::TestWithParam<std::tuple<IntegrationMethod, std::string>> {};

TEST_P(ImplicitAllocationTest, StepsAllocateNothing) {
  EXPECT_EQ(
      AllocationsOfFurtherFrames(std::get<0>(GetParam()), std::get<1>(GetParam())), 0);
}

INSTANTIATE_TEST_SUITE_P(
    Methods, ImplicitAllocationTest,
    testing::Combine(testing::Values(IntegrationMethod::kLinearlyImplicitEuler,
                                     IntegrationMethod::kImplicitEuler,
                                     IntegrationMethod::kTrBdf2),
                     testing::Values("cholesky", "cg")),
    [](const auto& info) {
      return IntegrationMethodName(std::get<0>(info.param)) + "_" +
             std::get<1>(info.param);
    });

TEST(LiveAllocationTest, FramesAllocateNothingWhileThingsMove) {
  Scene scene = MakePresetScene(ScenePreset::kSide);
  scene.colliders = {SphereCollider({0.0, -2.0, 0.0}, 1.0)};
  LiveSimulation live(scene);
  const int last = scene.objects[0].num_vertices() - 1;
  Eigen::Vector3d pin = scene.objects[0].positions.tail<3>();
  const auto run = [&](int num_frames) {
    const long before = allocation_count;
    for (int f = 0; f < num_frames; ++f) {
      pin.y() += 0.001;
      live.SetFixedPosition(0, last, pin);
      live.SetWind({0.1 * f, 0.0, 0.0});
      EXPECT_TRUE(live.AdvanceFrame().ok());
    }
    return allocation_count - before;
  };
  run(20);
  EXPECT_EQ(run(20), 0);
}

}  // namespace
}  // namespace dpe::test

#endif
