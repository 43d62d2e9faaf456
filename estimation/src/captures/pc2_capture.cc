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
#include <cstring>

#include "captures/readers.h"
#include "captures/text.h"
#include "dpe/engine/scene.h"

namespace dpe {
namespace {

constexpr long kHeaderBytes = 32;

std::uint32_t Word(const std::string& content, long byte) {
  std::uint32_t bits = 0;
  for (int i = 3; i >= 0; --i) {
    bits = bits << 8 | static_cast<unsigned char>(content[byte + i]);
  }
  return bits;
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
  const std::uint32_t bits = Word(content, byte);
  float value;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
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
  // In floating point, which does not overflow.
  const double expected = kHeaderBytes + 12.0 * static_cast<double>(block.num_frames) *
                                             static_cast<double>(block.num_vertices);
  if (expected != static_cast<double>(size)) {
    FailAtByte(path, size,
               "is the end of the file; accepted is an end at byte " +
                   std::to_string(static_cast<long>(expected)) + ", after " +
                   std::to_string(block.num_frames) + " samples of " +
                   std::to_string(block.num_vertices) + " points");
  }
  Capture capture;
  capture.path = path;
  capture.format = "PC2";
  capture.num_vertices = static_cast<int>(block.num_vertices);
  AppendDenseSamples(block, content, step, options.nan_is_missing, &capture);
  for (CaptureSample& sample : capture.samples) sample.time += start;
  return capture;
}

}  // namespace dpe
