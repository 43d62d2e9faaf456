// After the first step, steps allocate no memory of their own. What is left is
// CHOLMOD's: its supernodal factorisation allocates a dense workspace (the struct and
// its values) each time, inside the library.
//
// Counted by standing in for malloc and its kin, which sanitizers do themselves, and
// which needs glibc.
#include <gtest/gtest.h>

#include <cstdlib>

#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/simulator.h"

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)

namespace {
thread_local long allocation_count = 0;
}  // namespace

extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* pointer, size_t size);

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
}

namespace dpe::test {
namespace {

constexpr int kFrames = 20;
constexpr int kMoreFrames = 45;

// Allocations that each further frame of a rollout costs.
double AllocationsPerFrame(IntegrationMethod method) {
  Scene scene = MakePresetScene(ScenePreset::kFlag);
  scene.integration_method = method;
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
  return static_cast<double>(count(kMoreFrames) - count(kFrames)) /
         (kMoreFrames - kFrames);
}

TEST(AllocationTest, TheCounterCounts) {
  const long before = allocation_count;
  const std::vector<double> vector(100);
  EXPECT_EQ(allocation_count, before + 1) << vector.size();
}

TEST(AllocationTest, ExplicitStepsAllocateNothing) {
  EXPECT_EQ(AllocationsPerFrame(IntegrationMethod::kExplicitEuler), 0.0);
  EXPECT_EQ(AllocationsPerFrame(IntegrationMethod::kSymplecticEuler), 0.0);
}

TEST(AllocationTest, ALinearlyImplicitStepAllocatesWhatOneFactorizationDoes) {
  EXPECT_LE(AllocationsPerFrame(IntegrationMethod::kLinearlyImplicitEuler), 2.0);
}

TEST(AllocationTest, NewtonStepsAllocateWhatTheirFactorizationsDo) {
  // Two per factorisation, and Newton takes a handful of them per stage.
  EXPECT_LT(AllocationsPerFrame(IntegrationMethod::kImplicitEuler), 2.0 * 8);
  EXPECT_LT(AllocationsPerFrame(IntegrationMethod::kTrBdf2), 2.0 * 2 * 8);
}

}  // namespace
}  // namespace dpe::test

#endif
