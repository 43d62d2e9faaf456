// What a rollout keeps stays below the memory limit, and derivatives do not depend on
// it.
#include <gtest/gtest.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <string>
#include <tuple>
#include <utility>

#include "inner_states.h"
#include "memory_plan.h"
#include "support/integration_methods.h"
#include "support/sanitizers.h"
#include "support/scene_derivatives.h"
#include "support/test_scenes.h"

namespace dpe::test {
namespace {

constexpr std::size_t kNoLimit = std::size_t{1} << 40;

TEST(MemoryPlanTest, InnerStatesComeBeforeSolvers) {
  const std::vector<MemoryDemand> objects = {{100, 1000}, {50, 500}};
  const auto plan = [&](std::size_t limit) {
    const MemoryPlan p = PlanMemory(limit, 10, 2, objects);
    return std::make_pair(p.num_inner_frames, p.num_factors);
  };
  EXPECT_EQ(plan(0), std::make_pair(0, 0));
  EXPECT_EQ(plan(149), std::make_pair(0, 0));
  EXPECT_EQ(plan(450), std::make_pair(3, 0));
  EXPECT_EQ(plan(1500 + 1499), std::make_pair(10, 0));
  EXPECT_EQ(plan(1500 + 3000), std::make_pair(10, 2));
  EXPECT_EQ(plan(kNoLimit), std::make_pair(10, 20));
}

TEST(MemoryPlanTest, WhatAnObjectDoesNotHaveTakesNothing) {
  const MemoryPlan one_step = PlanMemory(100, 10, 1, {{0, 30}});
  EXPECT_EQ(one_step.num_inner_frames, 0);
  EXPECT_EQ(one_step.num_factors, 3);
  const MemoryPlan no_solver = PlanMemory(100, 10, 2, {{30, 0}});
  EXPECT_EQ(no_solver.num_inner_frames, 3);
  EXPECT_EQ(no_solver.num_factors, 0);
  const MemoryPlan nothing = PlanMemory(kNoLimit, 0, 2, {{30, 30}});
  EXPECT_EQ(nothing.num_inner_frames, 0);
  EXPECT_EQ(nothing.num_factors, 0);
}

Scene MakeScene(IntegrationMethod method, const std::string& solver,
                int steps_per_frame) {
  Scene scene = MakeDerivativeScene("two_objects", 5);
  scene.integration_method = method;
  scene.solver = solver;  // to the scene's tolerance of 1e-5, where first guesses show
  scene.steps_per_frame = steps_per_frame;
  if (method == IntegrationMethod::kExplicitEuler ||
      method == IntegrationMethod::kSymplecticEuler) {
    scene.delta = 0.0008;
  }
  Perturb(7, &scene);
  EstimateEverything(ParameterMode::kLocal, &scene);
  return scene;
}

using Case = std::tuple<IntegrationMethod, std::string, int>;

class MemoryLimitTest : public testing::TestWithParam<Case> {};

TEST_P(MemoryLimitTest, DerivativesDoNotDependOnIt) {
  const auto& [method, solver, steps_per_frame] = GetParam();
  const Scene scene = MakeScene(method, solver, steps_per_frame);
  constexpr int kFrames = 6;
  SimulatorOptions options;
  options.memory_limit_bytes = kNoLimit;
  const SceneDerivatives all = ComputeDerivatives(scene, options, kFrames);
  std::size_t frame = 0;
  for (const ClothObject& object : scene.objects) {
    frame += InnerStates::BytesPerFrame(3 * object.num_vertices(), steps_per_frame,
                                        method == IntegrationMethod::kTrBdf2 ? 2 : 1);
  }
  // Newton's methods go on from a kept factorisation of a nearby matrix; otherwise the
  // passes do the same arithmetic.
  const bool goes_on =
      solver == "cholesky" && (method == IntegrationMethod::kImplicitEuler ||
                               method == IntegrationMethod::kTrBdf2);
  const std::size_t inner = (kFrames - 1) * frame;
  EXPECT_GE(all.kept_bytes, inner);
  for (const std::size_t limit :
       {std::size_t{0}, 2 * frame + 1, inner, inner + (all.kept_bytes - inner) / 2}) {
    SCOPED_TRACE(limit);
    options.memory_limit_bytes = limit;
    const SceneDerivatives some = ComputeDerivatives(scene, options, kFrames);
    EXPECT_LE(some.kept_bytes, limit);
    EXPECT_GE(some.kept_bytes, std::min(limit, inner) / 2);
    EXPECT_LE(Distance(some, all), goes_on ? 1e-12 : 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(All, MemoryLimitTest,
                         testing::Combine(AllIntegrationMethods(),
                                          testing::Values("cholesky", "cg"),
                                          testing::Values(1, 3)),
                         [](const auto& info) {
                           return IntegrationMethodName(std::get<0>(info.param)) + "_" +
                                  std::get<1>(info.param) + "_" +
                                  std::to_string(std::get<2>(info.param));
                         });

TEST(MemoryLimitTest, FactorsOfSymmetricMatricesTakeLess) {
  std::size_t bytes[2];
  for (const double damping : {0.0, 0.1}) {
    Scene scene = MakeDerivativeScene("corners", 12);
    scene.integration_method = IntegrationMethod::kLinearlyImplicitEuler;
    scene.steps_per_frame = 1;
    scene.objects[0].damping = damping;
    scene.objects[0].drag_coefficient = 0.0;
    SimulatorOptions options;
    options.memory_limit_bytes = kNoLimit;
    Simulator simulator(scene, options);
    bytes[damping > 0.0] =
        simulator.Run(simulator.layout().Extract(scene), 4).kept_bytes();
  }
  EXPECT_GT(bytes[0], 0u);
  EXPECT_LT(bytes[0], 0.75 * bytes[1]);
}

TEST(MemoryLimitTest, OneStepOfOneStageKeepsFactorizationsAlone) {
  SimulatorOptions options;
  for (const char* solver : {"cholesky", "cg"}) {
    const Scene scene = MakeScene(IntegrationMethod::kLinearlyImplicitEuler, solver, 1);
    Simulator simulator(scene, options);
    const Rollout rollout = simulator.Run(simulator.layout().Extract(scene), 4);
    // The iterative solver would keep matrices, which are quickly made again.
    EXPECT_EQ(rollout.kept_bytes() > 0, std::string(solver) == "cholesky");
  }
}

#if defined(__GLIBC__) && !defined(DPE_TEST_SANITIZED)

std::size_t HeapBytes() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

Scene MakeLimitedScene(bool symmetric) {
  Scene scene = MakeDerivativeScene("corners", 12);
  scene.steps_per_frame = 2;
  if (symmetric) {
    scene.objects[0].damping = 0.0;
    scene.objects[0].drag_coefficient = 0.0;
  }
  return scene;
}

// Parameters may make the step matrix symmetric, whose factors are smaller, and
// non-symmetric again: memory of the one kind does not stay behind the other.
TEST(MemoryLimitTest, TheLimitHoldsWhereSymmetryChanges) {
  constexpr int kFrames = 60;
  Scene scene = MakeLimitedScene(true);
  scene.objects[0].estimate_damping = true;
  const Scene damped = [&] {
    Scene other = scene;
    other.objects[0].damping = 0.1;
    return other;
  }();
  SimulatorOptions options;
  options.memory_limit_bytes = 8'000'000;
  Simulator simulator(scene, options);
  ASSERT_TRUE(simulator.Simulate(3).status.ok());
  const std::size_t before = HeapBytes();
  for (const Scene* current : {&std::as_const(scene), &damped, &std::as_const(scene)}) {
    const Rollout rollout =
        simulator.Run(simulator.layout().Extract(*current), kFrames);
    ASSERT_TRUE(rollout.status().ok()) << rollout.status().Message();
    const double trajectory =
        2.0 * sizeof(double) * rollout.trajectory().positions[0].size();
    EXPECT_LE(static_cast<double>(HeapBytes() - before) - trajectory,
              1.05 * options.memory_limit_bytes);
    EXPECT_GE(rollout.kept_bytes(), options.memory_limit_bytes / 2);
  }
}

// The program's own count against the allocator's.
TEST(MemoryLimitTest, TheHeapGrowsByTheTrajectoryAndTheLimit) {
  constexpr int kFrames = 60;
  for (const auto& [method, symmetric] :
       {std::make_pair(IntegrationMethod::kLinearlyImplicitEuler, false),
        std::make_pair(IntegrationMethod::kLinearlyImplicitEuler, true),
        std::make_pair(IntegrationMethod::kTrBdf2, false)}) {
    Scene scene = MakeLimitedScene(symmetric);
    scene.integration_method = method;
    for (const std::size_t limit : {std::size_t{500'000}, std::size_t{8'000'000}}) {
      SimulatorOptions options;
      options.memory_limit_bytes = limit;
      Simulator simulator(scene, options);
      ASSERT_TRUE(simulator.Simulate(3).status.ok());
      const std::size_t before = HeapBytes();
      const Rollout rollout = simulator.Run(simulator.layout().Extract(scene), kFrames);
      const double growth = static_cast<double>(HeapBytes() - before);
      ASSERT_TRUE(rollout.status().ok()) << rollout.status().Message();
      const double trajectory =
          2.0 * sizeof(double) * rollout.trajectory().positions[0].size();
      EXPECT_LE(growth - trajectory, 1.05 * limit);
      // It is used, unless there is not so much to keep: methods with Newton's method
      // keep states alone.
      const bool all_fits = method == IntegrationMethod::kTrBdf2 && limit == 8'000'000;
      if (!all_fits) {
        EXPECT_GE(growth - trajectory, 0.8 * limit);
      }
      EXPECT_NEAR(growth - trajectory, rollout.kept_bytes(), 0.05 * limit);
    }
  }
}

#endif

}  // namespace
}  // namespace dpe::test
