#include "frame_interpolation.h"

#include <algorithm>
#include <cmath>

namespace dpe {
namespace {

constexpr double kSameTime = 1e-9;  // frames

}  // namespace

FrameWeights InterpolateFrames(double time, int num_frames) {
  FrameWeights result;
  const double nearest = std::round(time);
  if (std::abs(time - nearest) <= kSameTime || num_frames == 1) {
    result.first = std::clamp(static_cast<int>(nearest), 0, num_frames - 1);
    result.count = 1;
    result.weights[0] = 1.0;
    return result;
  }
  result.count = std::min(4, num_frames);
  result.first =
      std::clamp(static_cast<int>(std::floor(time)) - 1, 0, num_frames - result.count);
  for (int k = 0; k < result.count; ++k) {
    double weight = 1.0;
    for (int j = 0; j < result.count; ++j) {
      if (j != k) weight *= (time - result.first - j) / (k - j);
    }
    result.weights[k] = weight;
  }
  return result;
}

bool IsWithinFrames(double time, int num_frames) {
  return time <= num_frames - 1 + kSameTime;
}

}  // namespace dpe
