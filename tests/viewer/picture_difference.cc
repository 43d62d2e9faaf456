#include "picture_difference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "png/png.h"

namespace dpe::viewer {
namespace {

constexpr int kBlock = 8;  // pixels

std::string ReferencePath(const std::string& name) {
  return std::string(DPE_SOURCE_DIR) + "/tests/viewer/references/" + name + ".png";
}

std::array<double, 256> LinearTable() {
  std::array<double, 256> table{};
  for (int i = 0; i < 256; ++i) {
    const double value = i / 255.0;
    table[i] =
        value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  }
  return table;
}

double Linear(std::uint8_t srgb) {
  static const std::array<double, 256> table = LinearTable();
  return table[srgb];
}

double LabCurve(double t) {
  return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
}

// Of linear sRGB.
glm::dvec3 Lab(const glm::dvec3& rgb) {
  const double x = 0.4124 * rgb.r + 0.3576 * rgb.g + 0.1805 * rgb.b;
  const double y = 0.2126 * rgb.r + 0.7152 * rgb.g + 0.0722 * rgb.b;
  const double z = 0.0193 * rgb.r + 0.1192 * rgb.g + 0.9505 * rgb.b;
  const double fx = LabCurve(x / 0.9505);
  const double fy = LabCurve(y);
  const double fz = LabCurve(z / 1.089);
  return {116.0 * fy - 16.0, 500.0 * (fx - fy), 200.0 * (fy - fz)};
}

// The average light of a block, which is what the eye sees from far away.
glm::dvec3 BlockLab(const Image& image, int left, int top) {
  glm::dvec3 sum(0.0);
  const int right = std::min(left + kBlock, image.width);
  const int bottom = std::min(top + kBlock, image.height);
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      const std::uint8_t* pixel = image.Pixel(x, y);
      sum += glm::dvec3(Linear(pixel[0]), Linear(pixel[1]), Linear(pixel[2]));
    }
  }
  return Lab(sum / static_cast<double>((right - left) * (bottom - top)));
}

}  // namespace

PictureDifference Compare(const Image& a, const Image& b) {
  PictureDifference difference;
  int blocks = 0;
  for (int top = 0; top < a.height; top += kBlock) {
    for (int left = 0; left < a.width; left += kBlock) {
      const double of_block =
          glm::distance(BlockLab(a, left, top), BlockLab(b, left, top));
      difference.mean += of_block;
      difference.largest = std::max(difference.largest, of_block);
      ++blocks;
    }
  }
  difference.mean /= std::max(blocks, 1);
  return difference;
}

bool AreAlike(const PictureDifference& difference) {
  return difference.mean <= kAlike.mean && difference.largest <= kAlike.largest;
}

Image Reference(const std::string& name) { return ReadPng(ReferencePath(name)); }

::testing::AssertionResult MatchesReference(const Image& image,
                                            const std::string& name) {
  const char* const write = std::getenv("DPE_WRITE_REFERENCES");
  if (write != nullptr && std::string(write) == "1") {
    WritePng(ReferencePath(name), image);
  }
  const Image reference = Reference(name);
  std::string what;
  if (reference.width != image.width || reference.height != image.height) {
    what = "its size differs";
  } else {
    const PictureDifference difference = Compare(image, reference);
    if (AreAlike(difference)) return ::testing::AssertionSuccess();
    what = "mean difference " + std::to_string(difference.mean) + ", largest " +
           std::to_string(difference.largest);
  }
  const std::string kept = ::testing::TempDir() + "dpe_viewer_" + name + ".png";
  WritePng(kept, image);
  return ::testing::AssertionFailure()
         << name << ": not the reference: " << what << "; drawn: " << kept;
}

}  // namespace dpe::viewer
