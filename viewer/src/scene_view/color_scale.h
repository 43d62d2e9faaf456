// From a value to a colour, and the legend that says which.
#ifndef DPE_VIEWER_SCENE_VIEW_COLOR_SCALE_H_
#define DPE_VIEWER_SCENE_VIEW_COLOR_SCALE_H_

#include <glm/vec4.hpp>
#include <string>
#include <utility>
#include <vector>

namespace dpe::viewer {

// Linear RGBA of what is not known.
inline const glm::vec4 kUnknownColor(0.25f, 0.25f, 0.25f, 1.0f);

// Linear or logarithmic, from `low` to `high`.
struct ColorScale {
  std::string title;  // "stiffness", ...
  std::string unit;   // "N/m", ...
  double low = 0.0;
  double high = 1.0;
  bool logarithmic = false;

  // 0 at low, 1 at high; clamped. NaN stays NaN.
  double Position(double value) const;
  // Linear RGBA; kUnknownColor for NaN, magenta for what is infinite.
  glm::vec4 Color(double value) const;
  // Some values, low and high among them, with their text without unit.
  std::vector<std::pair<double, std::string>> Ticks() const;
};

// The scale over all finite values; logarithmic if they are positive and span more than
// a factor of 20. A single value is put in the middle.
ColorScale ScaleOver(const std::vector<double>& values);

// The smallest of 1, 1.5, 2, 3, 4, 5, 6, 8 times a power of ten that is not below a
// value.
double RoundUp(double value);

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_SCENE_VIEW_COLOR_SCALE_H_
