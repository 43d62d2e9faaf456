// What OffscreenRenderer draws, pixel by pixel.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "cloth_picture.h"
#include "render/offscreen_renderer.h"
#include "validated.h"

namespace dpe::viewer {
namespace {

constexpr int kSize = 64;
const glm::vec4 kRed(1, 0, 0, 1);
const glm::vec4 kBlue(0, 0, 1, 1);

int Srgb(double linear) {
  const double value =
      linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
  return static_cast<int>(std::lround(255 * value));
}

std::array<int, 3> At(const Image& image, int x, int y) {
  const std::uint8_t* pixel = image.Pixel(x, y);
  return {pixel[0], pixel[1], pixel[2]};
}

// World coordinates -1..1 fill the image, x to the right and y up, z towards the
// viewer.
Picture Flat() {
  Picture picture;
  picture.background = {0, 0, 0, 1};
  picture.camera.position = {0, 0, 10};
  picture.camera.projection = glm::mat4(1.0f);
  picture.camera.projection[1][1] = -1.0f;
  picture.camera.projection[2][2] = -0.5f;
  picture.camera.projection[3][2] = 0.5f;
  return picture;
}

// A square of half the image's width in the middle, facing the viewer.
Surface Square(float z, const glm::vec4& color) {
  Surface square;
  square.topology =
      std::make_shared<Topology>(Topology{std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3},
                                          std::vector<std::uint32_t>{0, 1, 2, 1}});
  square.positions = {
      {-0.5f, -0.5f, z}, {0.5f, -0.5f, z}, {0.5f, 0.5f, z}, {-0.5f, 0.5f, z}};
  square.normals.assign(4, glm::vec3(0, 0, 1));
  square.colors.assign(4, color);
  return square;
}

Lines Segment(const glm::vec3& a, const glm::vec3& b, float width) {
  Lines lines;
  lines.positions = {a, b};
  lines.colors.assign(2, kRed);
  lines.width = width;
  return lines;
}

// Pixels that are mostly red.
int CountRed(const Image& image) {
  int count = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const auto [red, green, blue] = At(image, x, y);
      if (red > 128 && green < 64 && blue < 64) ++count;
    }
  }
  return count;
}

class OffscreenRendererTest : public ValidatedTest {
 protected:
  Image Draw(const Picture& picture, const std::function<void()>& draw_ui = {}) {
    return OffscreenRenderer(options_, kSize, kSize).Render(picture, draw_ui);
  }
};

TEST_F(OffscreenRendererTest, TheBackgroundIsLinear) {
  Picture picture = Flat();
  picture.background = {0.5f, 0.2f, 0.01f, 1.0f};
  const Image image = OffscreenRenderer(options_, 7, 5).Render(picture);
  ASSERT_EQ(image.width, 7);
  ASSERT_EQ(image.height, 5);
  ASSERT_EQ(image.rgba.size(), 7u * 5 * 4);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 7; ++x) {
      const auto color = At(image, x, y);
      EXPECT_NEAR(color[0], Srgb(0.5), 1);
      EXPECT_NEAR(color[1], Srgb(0.2), 1);
      EXPECT_NEAR(color[2], Srgb(0.01), 1);
    }
  }
}

TEST_F(OffscreenRendererTest, TheInterfaceIsDrawnInItsOwnColors) {
  const Image image = Draw(Flat(), [] {
    ImGui::GetBackgroundDrawList()->AddRectFilled({8, 8}, {24, 24},
                                                  IM_COL32(10, 128, 250, 255));
  });
  EXPECT_EQ(At(image, 16, 16), (std::array<int, 3>{10, 128, 250}));
  EXPECT_EQ(At(image, 40, 40), (std::array<int, 3>{0, 0, 0}));
}

TEST_F(OffscreenRendererTest, AnInterfaceThatFailsSpoilsNothing) {
  OffscreenRenderer renderer(options_, kSize, kSize);
  EXPECT_THROW(renderer.Render(Flat(), [] { throw std::runtime_error("x"); }),
               std::runtime_error);
  EXPECT_EQ(CountRed(renderer.Render(Flat(),
                                     [] {
                                       ImGui::GetBackgroundDrawList()->AddRectFilled(
                                           {0, 0}, {10, 10}, IM_COL32(255, 0, 0, 255));
                                     })),
            100);
  EXPECT_EQ(CountRed(renderer.Render(Flat())), 0);
}

TEST_F(OffscreenRendererTest, NearerSurfacesHideFartherOnes) {
  Picture picture = Flat();
  picture.surfaces = {Square(0.5f, kRed), Square(0.0f, kBlue)};
  EXPECT_GT(At(Draw(picture), 32, 32)[0], 128);
  std::swap(picture.surfaces[0], picture.surfaces[1]);
  EXPECT_GT(At(Draw(picture), 32, 32)[0], 128);
  EXPECT_EQ(At(Draw(picture), 8, 32), (std::array<int, 3>{0, 0, 0}));
}

TEST_F(OffscreenRendererTest, TheBackIsDarkerAndBluer) {
  Picture picture = Flat();
  picture.light_direction = {0, 0, 1};
  picture.surfaces = {Square(0, {0.5f, 0.5f, 0.5f, 1.0f})};
  const auto front = At(Draw(picture), 32, 32);
  Surface& square = picture.surfaces[0];
  square.topology = std::make_shared<Topology>(
      Topology{std::vector<std::uint32_t>{1, 0, 2, 2, 0, 3}, {}});
  square.normals.assign(4, glm::vec3(0, 0, -1));
  const auto back = At(Draw(picture), 32, 32);
  EXPECT_EQ(front[0], front[2]);
  EXPECT_LT(back[0] + 20, front[0]);
  EXPECT_LT(back[0] + 10, back[2]);
  EXPECT_GT(back[0], front[0] / 2) << "the light reaches the side that is seen";
}

TEST_F(OffscreenRendererTest, LinesAreAsWideAsAskedFor) {
  Picture picture = Flat();
  for (const float width : {2.0f, 4.0f, 8.0f}) {
    picture.lines = {Segment({-0.5f, 0, 0}, {0.5f, 0, 0}, width)};
    EXPECT_EQ(CountRed(Draw(picture)), 32 * width);
    picture.lines = {Segment({0, -0.5f, 0}, {0, 0.5f, 0}, width)};
    EXPECT_EQ(CountRed(Draw(picture)), 32 * width);
  }
}

TEST_F(OffscreenRendererTest, LinesOnASurfaceAreSeenAndThoseBehindItAreNot) {
  Picture picture = Flat();
  picture.surfaces = {Square(0, kBlue)};
  picture.lines = {Segment({-0.5f, 0, 0}, {0.5f, 0, 0}, 2.0f)};
  EXPECT_EQ(CountRed(Draw(picture)), 64);
  for (glm::vec3& position : picture.lines[0].positions) position.z = -0.5f;
  EXPECT_EQ(CountRed(Draw(picture)), 0);
  picture.lines[0].on_top = true;
  EXPECT_EQ(CountRed(Draw(picture)), 64);
}

// From a camera in perspective: the part before the camera is drawn, the rest is not.
TEST_F(OffscreenRendererTest, LinesThatPassTheCameraAreCutOff) {
  Picture picture = Flat();
  picture.camera = LookAt({0, 0, 0}, {0, 0, -1}, 1.0f);
  picture.lines = {Segment({0, -0.3f, -2}, {0, -0.3f, 2}, 2.0f)};
  const Image image = Draw(picture);
  EXPECT_GT(At(image, 32, 60)[0], 128);
  EXPECT_EQ(At(image, 32, 10), (std::array<int, 3>{0, 0, 0}));
  for (glm::vec3& position : picture.lines[0].positions) position.z += 3.0f;
  EXPECT_EQ(CountRed(Draw(picture)), 0);
}

TEST_F(OffscreenRendererTest, PointsAreRound) {
  Picture picture = Flat();
  picture.points = {{{{0, 0, 0}}, kRed, 40.0f}};
  // The rim, a pixel wide, is partly too dark to count.
  const int red = CountRed(Draw(picture));
  EXPECT_GT(red, std::acos(-1.0) * 19 * 19);
  EXPECT_LT(red, std::acos(-1.0) * 20 * 20);
}

TEST_F(OffscreenRendererTest, TranslucentSurfacesLetThroughInLinearLight) {
  Picture picture = Flat();
  picture.background = {0.8f, 0.8f, 0.8f, 1.0f};
  picture.surfaces = {Square(0, {0, 0, 0, 0.5f})};
  picture.surfaces[0].normals.assign(4, glm::vec3(0, 0, -1));  // away from all light
  EXPECT_NEAR(At(Draw(picture), 32, 32)[1], Srgb(0.4), 2);
}

TEST_F(OffscreenRendererTest, EdgesAreSmooth) {
  OffscreenRenderer renderer(options_, kSize, kSize);
  if (renderer.samples() == 1) GTEST_SKIP() << "the device has one sample per pixel";
  Picture picture = Flat();
  picture.lines = {Segment({-0.9f, -0.7f, 0}, {0.9f, 0.8f, 0}, 6.0f)};
  const Image image = renderer.Render(picture);
  int between = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const int red = At(image, x, y)[0];
      if (red > 20 && red < 235) ++between;
    }
  }
  EXPECT_GT(between, kSize);
}

TEST_F(OffscreenRendererTest, ASurfaceHasTheEdgesOfItsTriangles) {
  Picture picture = Flat();
  picture.surfaces = {Square(0, kBlue)};
  EXPECT_EQ(CountRed(Draw(picture)), 0);
  picture.surfaces[0].edge_color = kRed;
  picture.surfaces[0].edge_width = 3.0f;
  const Image image = Draw(picture);
  const std::array<int, 3> red = {255, 0, 0};
  for (const int along : {20, 32, 44}) {
    EXPECT_EQ(At(image, along, 63 - along), red);  // the diagonal, up to the right
    EXPECT_EQ(At(image, 16, along), red);
    EXPECT_EQ(At(image, 47, along), red);
    EXPECT_EQ(At(image, along, 16), red);
    EXPECT_EQ(At(image, along, 47), red);
    EXPECT_NE(At(image, 14, along), red);  // what is outside is no part of the surface
  }
  for (const int off : {24, 40}) {
    EXPECT_LT(At(image, off, off)[0], 50) << "between the edges";
  }
  // Wholly covered is a pixel inside of each of the four sides, and one on both sides
  // of the diagonal.
  const double expected = 32 * 32 - 30 * 30 + 3 * 28;
  EXPECT_NEAR(CountRed(image), expected, 0.1 * expected);
  picture.surfaces[0].edge_color.a = 0.0f;
  EXPECT_EQ(CountRed(Draw(picture)), 0);
}

TEST_F(OffscreenRendererTest, EdgesThatWouldHideTheSurfaceFade) {
  Picture picture = Flat();
  picture.surfaces = {Square(0, kBlue)};
  picture.surfaces[0].edge_color = kRed;
  picture.surfaces[0].edge_width = 1.0f;
  EXPECT_GT(CountRed(Draw(picture)), 30);
  for (glm::vec3& position : picture.surfaces[0].positions) position *= 0.12f;
  const Image image = Draw(picture);  // triangles of less than four pixels
  EXPECT_EQ(CountRed(image), 0);
  EXPECT_GT(At(image, 31, 32)[2], At(image, 31, 32)[0]);
}

TEST_F(OffscreenRendererTest, TopologiesMayChangeAndGrow) {
  OffscreenRenderer renderer(options_, kSize, kSize);
  for (const int side : {4, 8, 3, 60, 12}) {
    const Picture picture = ClothPicture(side, 1.0f);
    EXPECT_EQ(renderer.Render(picture).rgba, Draw(picture).rgba) << side;
  }
}

TEST_F(OffscreenRendererTest, TheSamePictureIsDrawnTheSame) {
  OffscreenRenderer renderer(options_, kSize, kSize);
  const Picture picture = ClothPicture(12, 1.0f);
  const Image first = renderer.Render(picture);
  EXPECT_EQ(renderer.Render(picture).rgba, first.rgba);
}

TEST_F(OffscreenRendererTest, EmptyPartsAreLeftOut) {
  Picture picture = Flat();
  picture.surfaces.resize(2);
  picture.surfaces[1].topology = std::make_shared<Topology>();
  picture.lines.resize(1);
  picture.points.resize(1);
  EXPECT_EQ(CountRed(Draw(picture)), 0);
}

TEST_F(OffscreenRendererTest, PicturesThatDoNotFitTogetherAreRefused) {
  OffscreenRenderer renderer(options_, kSize, kSize);
  Picture picture = Flat();
  picture.surfaces = {Square(0, kRed)};
  picture.surfaces[0].colors.pop_back();
  EXPECT_THROW(renderer.Render(picture), std::invalid_argument);
  picture.surfaces = {Square(0, kRed)};
  picture.surfaces[0].positions.pop_back();
  picture.surfaces[0].normals.pop_back();
  picture.surfaces[0].colors.pop_back();
  EXPECT_THROW(renderer.Render(picture), std::invalid_argument);
  Surface bare = Square(0, kRed);
  bare.topology = std::make_shared<Topology>(Topology{bare.topology->triangles, {}});
  picture.surfaces = {bare};
  EXPECT_GT(CountRed(renderer.Render(picture)), 0);
  picture.surfaces[0].edge_width = 1.0f;  // needs corners
  EXPECT_THROW(renderer.Render(picture), std::invalid_argument);
  picture.surfaces = {Square(0, kRed)};
  EXPECT_GT(CountRed(renderer.Render(picture)), 0);
  picture.lines = {Segment({}, {}, 1.0f)};
  picture.lines[0].positions.pop_back();
  EXPECT_THROW(renderer.Render(picture), std::invalid_argument);
  EXPECT_THROW(OffscreenRenderer(options_, 0, 8), std::invalid_argument);
}

}  // namespace
}  // namespace dpe::viewer
