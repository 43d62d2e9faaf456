#include "png/png.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>

#include "support/temp_dir.h"

namespace dpe::viewer {
namespace {

Image Gradient() {
  Image image{5, 3, {}};
  for (int i = 0; i < 4 * 5 * 3; ++i) {
    image.rgba.push_back(static_cast<std::uint8_t>(i * 37));
  }
  return image;
}

std::string ErrorOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(PngTest, WhatWasWrittenIsRead) {
  const test::TempDir folder;
  const Image image = Gradient();
  WritePng(folder.File("a.png"), image);
  const Image read = ReadPng(folder.File("a.png"));
  EXPECT_EQ(read.width, image.width);
  EXPECT_EQ(read.height, image.height);
  EXPECT_EQ(read.rgba, image.rgba);
}

TEST(PngTest, ErrorsNameTheFile) {
  const test::TempDir folder;
  EXPECT_THAT(ErrorOf([&] { WritePng(folder.File("no/a.png"), Gradient()); }),
              ::testing::HasSubstr("no/a.png"));
  EXPECT_THAT(ErrorOf([&] { ReadPng(folder.File("b.png")); }),
              ::testing::HasSubstr("b.png"));
  test::WriteFile(folder.File("c.png"), "not a picture");
  EXPECT_THAT(ErrorOf([&] { ReadPng(folder.File("c.png")); }),
              ::testing::HasSubstr("c.png"));
}

}  // namespace
}  // namespace dpe::viewer
