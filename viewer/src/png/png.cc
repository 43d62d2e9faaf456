#include "png/png.h"

#include <memory>
#include <stdexcept>

// The implementation is compiled into this file, so that no library is needed where stb
// is a folder of headers. Static: it clashes with no other copy.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#endif
#include <stb_image.h>
#include <stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace dpe::viewer {

void WritePng(const std::string& path, const Image& image) {
  if (!stbi_write_png(path.c_str(), image.width, image.height, 4, image.rgba.data(),
                      4 * image.width)) {
    throw std::runtime_error(path +
                             ": the PNG cannot be written (is there such a folder, " +
                             "and may it be written to?)");
  }
}

Image ReadPng(const std::string& path) {
  Image image;
  int channels = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load(path.c_str(), &image.width, &image.height, &channels, 4),
      stbi_image_free);
  if (!pixels) {
    throw std::runtime_error(path +
                             ": cannot be read as PNG: " + stbi_failure_reason());
  }
  image.rgba.assign(pixels.get(),
                    pixels.get() + std::size_t{4} * image.width * image.height);
  return image;
}

}  // namespace dpe::viewer
