// Hard contact with large obstacles. A sphere pushes with K (r - |x - c|), which
// rounding leaves uncertain by eps K r wherever the cloth is: more than all that moves
// the cloth where K and r are large. Newton's method has to know, or it looks for a
// better solution than there is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/simulator.h"
#include "support/integration_methods.h"

namespace dpe::test {
namespace {

using Case = std::tuple<IntegrationMethod, double, double>;

class ContactRoundingTest : public testing::TestWithParam<Case> {};

// A loose level cloth that falls at 0.5 m/s.
Scene FallingScene(IntegrationMethod method, const Collider& collider,
                   double stiffness) {
  PresetOptions options;
  options.rows = options.cols = 5;
  Scene scene = MakePresetScene(ScenePreset::kSide, options);
  scene.integration_method = method;
  scene.delta = 0.002;
  ClothObject& cloth = scene.objects[0];
  UnpinAll(&cloth);
  for (int i = 0; i < cloth.num_vertices(); ++i) cloth.velocities[3 * i + 1] = -0.5;
  scene.colliders = {collider};
  scene.colliders[0].stiffness = stiffness;
  return scene;
}

void ExpectContact(const Scene& scene, double top) {
  Simulator simulator(scene);
  const Trajectory trajectory = simulator.Simulate(60);
  ASSERT_TRUE(trajectory.status.ok()) << trajectory.status.Message();
  double lowest = INFINITY;
  for (int i = 1; i < trajectory.positions[0].rows(); i += 3) {
    lowest = std::min(lowest, trajectory.positions[0].row(i).minCoeff());
  }
  EXPECT_LT(lowest, top);  // it touched
}

TEST_P(ContactRoundingTest, ASphereIsMet) {
  const auto [method, stiffness, radius] = GetParam();
  const Scene flat = FallingScene(method, SphereCollider({0.0, 0.0, 0.0}, 1.0), 1.0);
  // Under the cloth's middle vertex, 5 mm below.
  const Eigen::Vector3d middle = flat.objects[0].positions.segment<3>(3 * 12);
  const double top = middle.y() - 0.005;
  ExpectContact(
      FallingScene(method,
                   SphereCollider({middle.x(), top - radius, middle.z()}, radius),
                   stiffness),
      top);
}

std::string CaseName(const testing::TestParamInfo<Case>& info) {
  const auto [method, stiffness, radius] = info.param;
  return IntegrationMethodName(method) + "_1e" +
         std::to_string(std::lround(std::log10(stiffness))) + "_radius_" +
         std::to_string(std::lround(radius));
}

INSTANTIATE_TEST_SUITE_P(
    Obstacles, ContactRoundingTest,
    testing::Combine(testing::Values(IntegrationMethod::kLinearlyImplicitEuler,
                                     IntegrationMethod::kImplicitEuler,
                                     IntegrationMethod::kTrBdf2),
                     testing::Values(1e6, 1e9), testing::Values(1.0, 7.0, 1000.0)),
    CaseName);

}  // namespace
}  // namespace dpe::test
