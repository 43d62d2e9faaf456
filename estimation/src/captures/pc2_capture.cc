// Point caches (PC2): little-endian,
//
//   byte 0   char[12]  "POINTCACHE2" and a zero
//        12  int32     version, 1
//        16  int32     number of points
//        20  float32   start frame
//        24  float32   sample rate: frames from one sample to the next
//        28  int32     number of samples
//        32  float32   x, y, z of every point, sample after sample
#include <cmath>
#include <cstdint>

#include "captures/binary.h"
#include "captures/readers.h"
#include "captures/text.h"
#include "dpe/engine/scene.h"

namespace dpe {
namespace {

constexpr long kHeaderBytes = 32;

std::uint32_t Word(const std::string& content, long byte) {
  return ReadBits<std::uint32_t>(content.data() + byte);
}

long Count(const std::string& path, const std::string& content, long byte,
           const char* name) {
  const auto value = static_cast<std::int32_t>(Word(content, byte));
  if (value < 1) {
    FailAtByte(
        path, byte,
        std::string(name) + " is " + std::to_string(value) + "; accepted is 1 or more");
  }
  return value;
}

double Float(const std::string& content, long byte) {
  return ReadFloat<float, std::uint32_t>(content.data() + byte);
}

}  // namespace

Capture ReadPc2Capture(const std::string& path, const std::string& content,
                       const CaptureOptions& options) {
  const long size = static_cast<long>(content.size());
  if (size < kHeaderBytes) {
    FailAtByte(path, size, "ends within the header of 32 bytes of a point cache");
  }
  if (Word(content, 12) != 1) {
    FailAtByte(
        path, 12,
        "the version is " + std::to_string(Word(content, 12)) + "; accepted is 1");
  }
  DenseBlock block;
  block.path = path;
  block.format = "PC2";
  block.frames = "samples";
  block.vertices = "points";
  block.offset = kHeaderBytes;
  block.bytes = 4;
  block.num_vertices = Count(path, content, 16, "the number of points");
  block.num_frames = Count(path, content, 28, "the number of samples");
  const double start = Float(content, 20), step = Float(content, 24);
  if (!std::isfinite(start)) FailAtByte(path, 20, "the start frame is not finite");
  if (!std::isfinite(step) || !(step > 0.0)) {
    FailAtByte(path, 24,
               "the sample rate is " + std::to_string(step) +
                   "; accepted is a number > 0 (frames from one sample to the next)");
  }
  Capture capture = ReadDenseBlock(block, content, step, options.nan_is_missing);
  for (CaptureSample& sample : capture.samples) sample.time += start;
  return capture;
}

}  // namespace dpe
