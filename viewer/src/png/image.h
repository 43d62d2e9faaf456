// A picture of pixels in memory.
#ifndef DPE_VIEWER_PNG_IMAGE_H_
#define DPE_VIEWER_PNG_IMAGE_H_

#include <cstdint>
#include <vector>

namespace dpe::viewer {

// Rows from the top, four bytes per pixel: red, green, blue as sRGB, opacity.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;  // 4 * width * height

  const std::uint8_t* Pixel(int x, int y) const {
    return rgba.data() + 4 * (static_cast<std::size_t>(y) * width + x);
  }
};

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_PNG_IMAGE_H_
