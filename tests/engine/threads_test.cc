// Nothing depends on the number of threads: rollouts and all derivatives are equal bit
// by bit.
#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "support/integration_methods.h"
#include "support/scene_derivatives.h"
#include "support/test_scenes.h"

namespace dpe::test {
namespace {

using Case = std::tuple<IntegrationMethod, std::string>;

class ThreadsTest : public testing::TestWithParam<Case> {};

TEST_P(ThreadsTest, ResultsAreEqualBitByBit) {
  const auto& [method, solver] = GetParam();
  // Two objects, of which the second has more columns than fit into one block.
  Scene scene = MakeDerivativeScene("two_objects", 6);
  scene.integration_method = method;
  scene.solver = solver;
  const bool is_explicit = method == IntegrationMethod::kExplicitEuler ||
                           method == IntegrationMethod::kSymplecticEuler;
  if (is_explicit) scene.delta = 0.0008;
  scene.steps_per_frame = 2;
  Perturb(7, &scene);
  EstimateEverything(ParameterMode::kLocal, &scene);
  SimulatorOptions options;
  const SceneDerivatives one = ComputeDerivatives(scene, options, 5);
  ASSERT_GT(one.gradient.size(), 400);
  for (const int num_threads : {2, 3}) {
    options.num_threads = num_threads;
    EXPECT_EQ(Distance(ComputeDerivatives(scene, options, 5), one), 0.0) << num_threads;
  }
}

// With more columns and rows than one block has.
TEST(ThreadsTest, LargeSystemsAreSolvedAlike) {
  Scene scene = MakeDerivativeScene("side", 22);
  Perturb(7, &scene);
  ClothObject& cloth = scene.objects[0];
  cloth.stiffness_mode = ParameterMode::kGroup;
  cloth.spring_group.resize(cloth.num_springs());
  for (int s = 0; s < cloth.num_springs(); ++s) cloth.spring_group[s] = s % 100;
  for (const char* solver : {"cholesky", "cg"}) {
    scene.solver = solver;
    SimulatorOptions options;
    const SceneDerivatives one = ComputeDerivatives(scene, options, 3);
    options.num_threads = 3;
    EXPECT_EQ(Distance(ComputeDerivatives(scene, options, 3), one), 0.0) << solver;
  }
}

INSTANTIATE_TEST_SUITE_P(All, ThreadsTest,
                         testing::Combine(AllIntegrationMethods(),
                                          testing::Values("cholesky", "cg")),
                         [](const auto& info) {
                           return IntegrationMethodName(std::get<0>(info.param)) + "_" +
                                  std::get<1>(info.param);
                         });

}  // namespace
}  // namespace dpe::test
