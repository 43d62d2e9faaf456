#include <cmath>
#include <cstdint>
#include <string>

#include "captures/binary.h"
#include "captures/readers.h"
#include "captures/text.h"
#include "dpe/engine/scene.h"

namespace dpe {
void FailAtByte(const std::string& path, long byte, const std::string& what) {
  throw SceneError(path + ": byte " + std::to_string(byte) + ": " + what);
}

namespace {

// The file ends where the numbers do.
void RequireEnd(const DenseBlock& block, const std::string& content) {
  // In floating point, which does not overflow.
  const double expected = static_cast<double>(block.offset) +
                          3.0 * block.bytes * static_cast<double>(block.num_frames) *
                              static_cast<double>(block.num_vertices);
  if (expected == static_cast<double>(content.size())) return;
  // A header may promise more than any whole number holds.
  const std::string end = expected < 1e15 ? std::to_string(static_cast<long>(expected))
                                          : NumberField(expected);
  FailAtByte(block.path, static_cast<long>(content.size()),
             "is the end of the file; accepted is an end at byte " + end + ", after " +
                 std::to_string(block.num_frames) + " " + block.frames + " of " +
                 std::to_string(block.num_vertices) + " " + block.vertices);
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
                ? ReadFloat<float, std::uint32_t>(bytes, block.big_endian)
                : ReadFloat<double, std::uint64_t>(bytes, block.big_endian);
        num_nan += std::isnan(sample.position[c]) ? 1 : 0;
      }
      if (num_nan == 3 && nan_is_missing) continue;
      for (int c = 0; c < 3; ++c) {
        if (std::isfinite(sample.position[c])) continue;
        FailAtByte(block.path, place[c],
                   "frame " + std::to_string(f) + ", vertex " + std::to_string(v) +
                       ": " + "xyz"[c] + " is " + NumberField(sample.position[c]) +
                       "; accepted is a finite number, or three nan where nan is "
                       "declared to mean that a vertex was not seen");
      }
      capture->samples.push_back(sample);
    }
  }
  if (capture->samples.empty()) throw SceneError(block.path + ": has no data");
}

}  // namespace

Capture ReadDenseBlock(const DenseBlock& block, const std::string& content, double step,
                       bool nan_is_missing) {
  RequireEnd(block, content);
  Capture capture;
  capture.path = block.path;
  capture.format = block.format;
  capture.num_vertices = static_cast<int>(block.num_vertices);
  AppendDenseSamples(block, content, step, nan_is_missing, &capture);
  return capture;
}

}  // namespace dpe
