// Images as PNG files.
#ifndef DPE_VIEWER_PNG_PNG_H_
#define DPE_VIEWER_PNG_PNG_H_

#include <string>

#include "png/image.h"

namespace dpe::viewer {

// Writes an image. Throws std::runtime_error that names the file if it cannot be
// written.
void WritePng(const std::string& path, const Image& image);

// Reads a PNG file of any colour type as RGBA. Throws std::runtime_error that names the
// file and the reason if it cannot be read.
Image ReadPng(const std::string& path);

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_PNG_PNG_H_
