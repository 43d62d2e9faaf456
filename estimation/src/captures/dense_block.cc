#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

#include "captures/readers.h"
#include "captures/text.h"
#include "dpe/engine/scene.h"

namespace dpe {
namespace {

// Assembled byte by byte, whatever the order of this machine.
template <typename Float, typename Bits>
double ReadNumber(const char* bytes, bool big_endian) {
  Bits bits = 0;
  for (size_t i = 0; i < sizeof(Bits); ++i) {
    const size_t byte = big_endian ? i : sizeof(Bits) - 1 - i;
    bits = static_cast<Bits>(bits << 8 | static_cast<unsigned char>(bytes[byte]));
  }
  Float value;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

}  // namespace

void FailAtByte(const std::string& path, long byte, const std::string& what) {
  throw SceneError(path + ": byte " + std::to_string(byte) + ": " + what);
}

void AppendDenseSamples(const DenseBlock& block, const std::string& content,
                        double step, bool nan_is_missing, Capture* capture) {
  const long frames = block.num_frames, vertices = block.num_vertices;
  capture->samples.reserve(capture->samples.size() + frames * vertices);
  for (long f = 0; f < frames; ++f) {
    for (long v = 0; v < vertices; ++v) {
      CaptureSample sample;
      sample.marker = static_cast<int>(v);
      sample.time = static_cast<double>(f) * step;
      long place[3];
      int num_nan = 0;
      for (long c = 0; c < 3; ++c) {
        const long index = block.fortran_order ? f + frames * (v + vertices * c)
                                               : (f * vertices + v) * 3 + c;
        place[c] = block.offset + index * block.bytes;
        const char* bytes = content.data() + place[c];
        sample.position[c] =
            block.bytes == 4
                ? ReadNumber<float, std::uint32_t>(bytes, block.big_endian)
                : ReadNumber<double, std::uint64_t>(bytes, block.big_endian);
        num_nan += std::isnan(sample.position[c]) ? 1 : 0;
      }
      if (num_nan == 3 && nan_is_missing) continue;
      for (int c = 0; c < 3; ++c) {
        if (std::isfinite(sample.position[c])) continue;
        FailAtByte(block.path, place[c],
                   "frame " + std::to_string(f) + ", vertex " + std::to_string(v) +
                       ": " + "xyz"[c] + " is " + NumberText(sample.position[c]) +
                       "; accepted is a finite number, or three nan where nan is "
                       "declared to mean that a vertex was not seen");
      }
      capture->samples.push_back(sample);
    }
  }
  if (capture->samples.empty()) throw SceneError(block.path + ": has no data");
}

}  // namespace dpe
