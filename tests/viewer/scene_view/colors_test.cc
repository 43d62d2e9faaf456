#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "scene_view/color_scale.h"
#include "scene_view/quantities.h"
#include "scene_view/viridis.h"
#include "support/test_scenes.h"

namespace dpe::viewer {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(ViridisTest, HasTheEndsOfTheMapAndGrowsLighterAllTheWay) {
  const glm::vec3 low = ViridisSrgb(0.0f), high = ViridisSrgb(1.0f);
  EXPECT_NEAR(low.x, 0.267f, 1e-3f);
  EXPECT_NEAR(low.z, 0.329f, 1e-3f);
  EXPECT_NEAR(high.x, 0.993f, 1e-3f);
  EXPECT_NEAR(high.y, 0.906f, 1e-3f);
  double last = -1.0, smallest = 1.0, largest = 0.0;
  for (int k = 0; k <= 50; ++k) {
    const glm::vec3 c = LinearFromSrgb(ViridisSrgb(k / 50.0f));
    const double luminance = 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z;
    const double lightness = std::cbrt(luminance);  // of CIE, but for a factor
    if (k > 0) {
      smallest = std::min(smallest, lightness - last);
      largest = std::max(largest, lightness - last);
    }
    last = lightness;
  }
  EXPECT_GT(smallest, 0.0);
  EXPECT_LT(largest, 2.5 * smallest);  // equal steps look about equal
}

TEST(ColorScaleTest, SpansItsValuesAndTellsWhatIsNotKnown) {
  const ColorScale linear = ScaleOver({1.0, kNaN, 5.0, 3.0, kInfinity});
  EXPECT_EQ(linear.low, 1.0);
  EXPECT_EQ(linear.high, 5.0);
  EXPECT_FALSE(linear.logarithmic);
  EXPECT_EQ(linear.Position(2.0), 0.25);
  EXPECT_EQ(linear.Position(9.0), 1.0);
  const ColorScale wide = ScaleOver({0.1, 1000.0});
  EXPECT_TRUE(wide.logarithmic);
  EXPECT_NEAR(wide.Position(10.0), 0.5, 1e-12);
  EXPECT_EQ(wide.Ticks()[2].second, "10");
  const ColorScale single = ScaleOver({4.0, 4.0});
  EXPECT_NEAR(single.Position(4.0), 0.5, 1e-12);
  const ColorScale zero = ScaleOver({0.0});
  EXPECT_NEAR(zero.Position(0.0), 0.5, 1e-12);
  // Neither grey nor magenta is on the map.
  for (const double value : {kNaN, kInfinity}) {
    for (int k = 0; k <= 100; ++k) {
      const glm::vec4 difference = linear.Color(value) - linear.Color(1.0 + 0.04 * k);
      EXPECT_GT(
          std::abs(difference.x) + std::abs(difference.y) + std::abs(difference.z),
          0.08f);
    }
  }
  EXPECT_NE(linear.Color(kNaN), linear.Color(kInfinity));
}

TEST(ColorScaleTest, RoundsUpToWhatIsEasilyRead) {
  EXPECT_EQ(RoundUp(1.0), 1.0);
  EXPECT_EQ(RoundUp(1.1), 1.5);
  EXPECT_EQ(RoundUp(0.021), 0.03);
  EXPECT_EQ(RoundUp(900.0), 1000.0);
}

TEST(QuantitiesTest, AreThoseOfTheElements) {
  Scene scene = test::MakeDerivativeScene("side", 4);
  test::Perturb(3, &scene);
  const ClothObject& cloth = scene.objects[0];
  const Eigen::VectorXd rest = RestLengths(cloth);
  const Eigen::VectorXd positions = 1.1 * cloth.positions;
  QuantityInput input;
  input.object = &cloth;
  input.rest_lengths = &rest;
  input.positions = &positions;
  input.velocities = &cloth.velocities;
  input.reference = &cloth.positions;
  for (const double stretch : ValuesOf(ColorMode::kStretch, input).of_springs) {
    EXPECT_NEAR(stretch, 10.0, 1e-9);
  }
  EXPECT_NEAR(ValuesOf(ColorMode::kStretch, input).of_vertices[5], 10.0, 1e-9);
  EXPECT_EQ(ValuesOf(ColorMode::kStiffness, input).of_springs[7], cloth.stiffness[7]);
  double sum = 0.0;
  int count = 0;
  for (int s = 0; s < cloth.num_springs(); ++s) {
    if (cloth.springs[s][0] != 5 && cloth.springs[s][1] != 5) continue;
    sum += cloth.stiffness[s];
    ++count;
  }
  EXPECT_NEAR(ValuesOf(ColorMode::kStiffness, input).of_vertices[5], sum / count, 1e-9);
  EXPECT_EQ(ValuesOf(ColorMode::kMass, input).of_vertices[6], cloth.mass[6]);
  EXPECT_NEAR(ValuesOf(ColorMode::kSpeed, input).of_vertices[6],
              cloth.velocities.segment<3>(18).norm(), 1e-12);
  EXPECT_NEAR(ValuesOf(ColorMode::kDistance, input).of_vertices[6],
              0.1 * cloth.positions.segment<3>(18).norm(), 1e-9);
  input.reference = nullptr;
  EXPECT_TRUE(std::isnan(ValuesOf(ColorMode::kDistance, input).of_vertices[6]));
}

TEST(QuantitiesTest, NamesAreReadBack) {
  for (int m = 0; m < kNumColorModes; ++m) {
    const auto mode = static_cast<ColorMode>(m);
    EXPECT_EQ(ColorModeFromName(ColorModeName(mode)), mode);
  }
  EXPECT_THROW(ColorModeFromName("rainbow"), SceneError);
}

}  // namespace
}  // namespace dpe::viewer
