// What a cloth can be coloured by.
#ifndef DPE_VIEWER_SCENE_VIEW_QUANTITIES_H_
#define DPE_VIEWER_SCENE_VIEW_QUANTITIES_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "dpe/engine/scene.h"
#include "playback/motion_state.h"

namespace dpe::viewer {

enum class ColorMode {
  kPlain,
  kStiffness,  // N/m, of springs; of a vertex: the mean of its springs
  kMass,       // kg, of vertices
  kStretch,    // %, (l - L0) / L0 of springs; of a vertex: the mean of its springs
  kSpeed,      // m/s, of vertices
  kDistance,   // m, of vertices from those of the target or the compared scene
  kDeviation,  // the estimate's standard deviation, of stiffness or mass
};
constexpr int kNumColorModes = 7;

// plain, stiffness, mass, stretch, speed, distance, deviation.
std::string ColorModeName(ColorMode mode);
// @throws SceneError naming what is accepted
ColorMode ColorModeFromName(const std::string& name);

// Standard deviations of an estimation's report, one vector per object: per spring
// (N/m) and per vertex (kg). NaN: not estimated; infinite: not determined. Empty: the
// object's was not estimated.
struct Deviations {
  std::vector<Eigen::VectorXd> stiffness;
  std::vector<Eigen::VectorXd> mass;
  bool has_stiffness() const;
  bool has_mass() const;
};

// The values of one object; vectors without entries where a quantity is not of springs,
// or not of vertices. NaN: not known.
struct QuantityValues {
  std::vector<double> of_vertices;
  std::vector<double> of_springs;
};

struct QuantityInput {
  const ClothObject* object = nullptr;
  const Eigen::VectorXd* rest_lengths = nullptr;  // m, per spring
  const Eigen::VectorXd* positions = nullptr;     // 3N, m
  const Eigen::VectorXd* velocities = nullptr;    // 3N, m/s
  // 3N, m: what distances are to; null: nothing
  const Eigen::VectorXd* reference = nullptr;
  const Eigen::VectorXd* stiffness_deviation = nullptr;  // null: not known
  const Eigen::VectorXd* mass_deviation = nullptr;
};

QuantityValues ValuesOf(ColorMode mode, const QuantityInput& input);

// "stiffness" and "N/m", ...: title and unit of a mode's legend.
std::string QuantityTitle(ColorMode mode, bool of_mass);
std::string QuantityUnit(ColorMode mode, bool of_mass);

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_SCENE_VIEW_QUANTITIES_H_
