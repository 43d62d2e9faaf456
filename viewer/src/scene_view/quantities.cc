#include "scene_view/quantities.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dpe::viewer {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
const char* const kNames[kNumColorModes] = {"plain", "stiffness", "mass",     "stretch",
                                            "speed", "distance",  "deviation"};

std::vector<double> Copy(const Eigen::VectorXd& values) {
  return {values.data(), values.data() + values.size()};
}

// The mean over the springs of each vertex; NaN without any that is known.
std::vector<double> MeanOfSprings(const ClothObject& object,
                                  const std::vector<double>& of_springs) {
  std::vector<double> sum(object.num_vertices(), 0.0), count(sum);
  for (int s = 0; s < object.num_springs(); ++s) {
    if (std::isnan(of_springs[s])) continue;
    for (const int vertex : object.springs[s]) {
      sum[vertex] += of_springs[s];
      count[vertex] += 1.0;
    }
  }
  for (size_t i = 0; i < sum.size(); ++i)
    sum[i] = count[i] > 0 ? sum[i] / count[i] : kNaN;
  return sum;
}

QuantityValues OfSprings(const ClothObject& object, std::vector<double> of_springs) {
  QuantityValues values;
  values.of_vertices = MeanOfSprings(object, of_springs);
  values.of_springs = std::move(of_springs);
  return values;
}

std::vector<double> Stretch(const QuantityInput& input) {
  std::vector<double> stretch(input.object->num_springs(), kNaN);
  for (size_t s = 0; s < stretch.size(); ++s) {
    const auto& [a, b] = input.object->springs[s];
    const double length =
        (input.positions->segment<3>(3 * a) - input.positions->segment<3>(3 * b))
            .norm();
    const double rest = (*input.rest_lengths)[s];
    stretch[s] = 100.0 * (length - rest) / rest;
  }
  return stretch;
}

// Norms of the 3-vectors of a, or of a - b.
std::vector<double> Norms(const Eigen::VectorXd* a, const Eigen::VectorXd* b, int n) {
  std::vector<double> norms(n, kNaN);
  if (a == nullptr || a->size() != 3 * n || (b != nullptr && b->size() != 3 * n)) {
    return norms;
  }
  for (int i = 0; i < n; ++i) {
    Eigen::Vector3d value = a->segment<3>(3 * i);
    if (b != nullptr) value -= b->segment<3>(3 * i);
    norms[i] = value.norm();
  }
  return norms;
}

}  // namespace

std::string ColorModeName(ColorMode mode) { return kNames[static_cast<int>(mode)]; }

ColorMode ColorModeFromName(const std::string& name) {
  for (int m = 0; m < kNumColorModes; ++m) {
    if (name == kNames[m]) return static_cast<ColorMode>(m);
  }
  throw SceneError("colouring \"" + name +
                   "\" is not known; expected plain, stiffness, mass, stretch, speed, "
                   "distance or deviation");
}

bool Deviations::has_stiffness() const {
  return std::any_of(stiffness.begin(), stiffness.end(),
                     [](const auto& values) { return values.size() > 0; });
}

bool Deviations::has_mass() const {
  return std::any_of(mass.begin(), mass.end(),
                     [](const auto& values) { return values.size() > 0; });
}

QuantityValues ValuesOf(ColorMode mode, const QuantityInput& input) {
  const ClothObject& object = *input.object;
  const int n = object.num_vertices();
  switch (mode) {
    case ColorMode::kPlain:
      return {};
    case ColorMode::kStiffness:
      return OfSprings(object, Copy(object.stiffness));
    case ColorMode::kMass:
      return {Copy(object.mass), {}};
    case ColorMode::kStretch:
      return OfSprings(object, Stretch(input));
    case ColorMode::kSpeed:
      return {Norms(input.velocities, nullptr, n), {}};
    case ColorMode::kDistance:
      if (input.reference == nullptr) return {std::vector<double>(n, kNaN), {}};
      return {Norms(input.positions, input.reference, n), {}};
    case ColorMode::kDeviation:
      if (input.stiffness_deviation != nullptr) {
        return OfSprings(object, Copy(*input.stiffness_deviation));
      }
      if (input.mass_deviation != nullptr) return {Copy(*input.mass_deviation), {}};
      return {std::vector<double>(n, kNaN), {}};
  }
  return {};
}

std::string QuantityTitle(ColorMode mode, bool of_mass) {
  switch (mode) {
    case ColorMode::kDistance:
      return "distance to target";
    case ColorMode::kDeviation:
      return of_mass ? "standard deviation of mass" : "standard deviation of stiffness";
    default:
      return ColorModeName(mode);
  }
}

std::string QuantityUnit(ColorMode mode, bool of_mass) {
  switch (mode) {
    case ColorMode::kPlain:
      return "";
    case ColorMode::kStiffness:
      return "N/m";
    case ColorMode::kMass:
      return "kg";
    case ColorMode::kStretch:
      return "%";
    case ColorMode::kSpeed:
      return "m/s";
    case ColorMode::kDistance:
      return "m";
    case ColorMode::kDeviation:
      return of_mass ? "kg" : "N/m";
  }
  return "";
}

}  // namespace dpe::viewer
