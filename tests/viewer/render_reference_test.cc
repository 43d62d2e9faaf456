// Pictures against references, and that wrong pictures are told from right ones.
#include <gtest/gtest.h>

#include <functional>
#include <glm/ext/matrix_transform.hpp>

#include "cloth_picture.h"
#include "picture_difference.h"
#include "render/offscreen_renderer.h"
#include "validated.h"

namespace dpe::viewer {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;

class RenderReferenceTest : public ValidatedTest {
 protected:
  Image Draw(const Picture& picture) {
    return OffscreenRenderer(options_, kWidth, kHeight).Render(picture);
  }
  static Picture Cloth() { return ClothPicture(24, float{kWidth} / kHeight); }

  // The difference from the reference of the cloth after `change`.
  PictureDifference After(const std::function<void(Picture*)>& change) {
    Picture picture = Cloth();
    change(&picture);
    const PictureDifference difference = Compare(Draw(picture), Reference("cloth"));
    RecordProperty("mean", std::to_string(difference.mean));
    RecordProperty("largest", std::to_string(difference.largest));
    return difference;
  }
};

// Far enough from the limits on either side that they do not depend on luck.
::testing::AssertionResult IsClearlyAlike(const PictureDifference& difference) {
  const PictureDifference twice{2 * difference.mean, 2 * difference.largest};
  if (AreAlike(twice)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << "mean " << difference.mean << ", largest " << difference.largest;
}

::testing::AssertionResult IsClearlyDifferent(const PictureDifference& difference) {
  const PictureDifference half{difference.mean / 2, difference.largest / 2};
  if (!AreAlike(half)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << "mean " << difference.mean << ", largest " << difference.largest;
}

void Mirror(Picture* picture, int axis_a, int axis_b) {
  for (std::vector<glm::vec3>* vectors :
       {&picture->surfaces[0].positions, &picture->surfaces[0].normals,
        &picture->lines[1].positions}) {
    for (glm::vec3& vector : *vectors) {
      if (axis_a == axis_b) {
        vector[axis_a] = -vector[axis_a];
      } else {
        std::swap(vector[axis_a], vector[axis_b]);
      }
    }
  }
}

TEST_F(RenderReferenceTest, Cloth) {
  EXPECT_TRUE(MatchesReference(Draw(Cloth()), "cloth"));
}

// What another driver may do: Vulkan wants vertices to be placed to 1/16 of a pixel
// (subPixelPrecisionBits >= 4), which decides about samples at edges.
TEST_F(RenderReferenceTest, TheGridOfAnotherRasterizerIsNotSeen) {
  EXPECT_TRUE(IsClearlyAlike(After([](Picture* picture) {
    glm::mat4& projection = picture->camera.projection;
    projection = glm::translate(glm::mat4(1.0f),
                                {2.0f / 16 / kWidth, 2.0f / 16 / kHeight, 0.0f}) *
                 projection;
  })));
}

// Other rounding.
TEST_F(RenderReferenceTest, ABitOfColorIsNotSeen) {
  EXPECT_TRUE(IsClearlyAlike(After([](Picture* picture) {
    for (glm::vec4& color : picture->surfaces[0].colors) color.g += 1.0f / 255.0f;
  })));
}

TEST_F(RenderReferenceTest, AWrongWindingIsSeen) {
  EXPECT_TRUE(IsClearlyDifferent(After([](Picture* picture) {
    Surface& sheet = picture->surfaces[0];
    auto turned = std::make_shared<Topology>(*sheet.topology);
    for (std::size_t i = 0; i < turned->triangles.size(); i += 3) {
      std::swap(turned->triangles[i], turned->triangles[i + 1]);
    }
    sheet.topology = turned;
  })));
}

TEST_F(RenderReferenceTest, AWrongWindingWithNormalsThatFollowItIsSeen) {
  EXPECT_TRUE(IsClearlyDifferent(After([](Picture* picture) {
    Surface& sheet = picture->surfaces[0];
    auto turned = std::make_shared<Topology>(*sheet.topology);
    for (std::size_t i = 0; i < turned->triangles.size(); i += 3) {
      std::swap(turned->triangles[i], turned->triangles[i + 1]);
    }
    sheet.normals = Normals(sheet.positions, turned->triangles);
    sheet.topology = turned;
  })));
}

TEST_F(RenderReferenceTest, TheWrongWindingOfOneTriangleIsSeen) {
  EXPECT_TRUE(IsClearlyDifferent(After([](Picture* picture) {
    Surface& sheet = picture->surfaces[0];
    auto turned = std::make_shared<Topology>(*sheet.topology);
    const std::size_t middle = 3 * (2 * 23 * 16 + 2 * 8);
    std::swap(turned->triangles[middle], turned->triangles[middle + 1]);
    sheet.topology = turned;
  })));
}

TEST_F(RenderReferenceTest, SwappedAxesAreSeen) {
  for (int a = 0; a < 3; ++a) {
    for (int b = a; b < 3; ++b) {
      EXPECT_TRUE(IsClearlyDifferent(After([&](Picture* picture) {
        Mirror(picture, a, b);
      }))) << "axes "
           << a << " and " << b;
    }
  }
}

TEST_F(RenderReferenceTest, MissingNormalsAreSeen) {
  EXPECT_TRUE(IsClearlyDifferent(After([](Picture* picture) {
    for (glm::vec3& normal : picture->surfaces[0].normals) normal = glm::vec3(0.0f);
  })));
  EXPECT_TRUE(IsClearlyDifferent(After([](Picture* picture) {
    picture->surfaces[0].normals[24 * 16 + 8] = glm::vec3(0.0f);
  }))) << "of one vertex";
}

TEST_F(RenderReferenceTest, MissingMarksAreSeen) {
  EXPECT_TRUE(
      IsClearlyDifferent(After([](Picture* picture) { picture->points.clear(); })));
  for (int lines = 0; lines < 3; ++lines) {
    EXPECT_TRUE(IsClearlyDifferent(After([&](Picture* picture) {
      picture->lines.erase(picture->lines.begin() + lines);
    }))) << "lines "
         << lines;
  }
}

}  // namespace
}  // namespace dpe::viewer
