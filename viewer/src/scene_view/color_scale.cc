#include "scene_view/color_scale.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "scene_view/viridis.h"

namespace dpe::viewer {
namespace {

constexpr int kNumTicks = 5;
constexpr double kLogarithmicSpan = 20.0;
const glm::vec4 kInfinite(0.8f, 0.05f, 0.6f, 1.0f);

}  // namespace

double ColorScale::Position(double value) const {
  const double t = logarithmic ? std::log(value / low) / std::log(high / low)
                               : (value - low) / (high - low);
  return std::isnan(t) ? t : std::clamp(t, 0.0, 1.0);
}

glm::vec4 ColorScale::Color(double value) const {
  if (std::isinf(value)) return kInfinite;
  const double t = Position(value);
  if (std::isnan(t)) return kUnknownColor;
  return glm::vec4(LinearFromSrgb(ViridisSrgb(static_cast<float>(t))), 1.0f);
}

std::vector<std::pair<double, std::string>> ColorScale::Ticks() const {
  std::vector<std::pair<double, std::string>> ticks;
  for (int k = 0; k < kNumTicks; ++k) {
    const double t = static_cast<double>(k) / (kNumTicks - 1);
    const double value =
        logarithmic ? low * std::pow(high / low, t) : low + t * (high - low);
    char text[32];
    std::snprintf(text, sizeof(text), "%.3g", std::abs(value) < 1e-12 ? 0.0 : value);
    ticks.emplace_back(value, text);
  }
  return ticks;
}

ColorScale ScaleOver(const std::vector<double>& values) {
  ColorScale scale;
  bool any = false;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    scale.low = any ? std::min(scale.low, value) : value;
    scale.high = any ? std::max(scale.high, value) : value;
    any = true;
  }
  // Equal values differ by rounding.
  const double size = std::max(std::abs(scale.low), std::abs(scale.high));
  if (scale.high - scale.low <= 1e-9 * size || size == 0.0) {
    const double half = size > 0.0 ? 0.5 * size : 0.5;
    const double middle = 0.5 * (scale.low + scale.high);
    scale.low = middle - half;
    scale.high = middle + half;
  }
  scale.logarithmic = scale.low > 0.0 && scale.high > kLogarithmicSpan * scale.low;
  return scale;
}

double RoundUp(double value) {
  if (!(value > 0.0) || !std::isfinite(value)) return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0}) {
    if (step * power >= value * (1.0 - 1e-12)) return step * power;
  }
  return 10.0 * power;
}

}  // namespace dpe::viewer
