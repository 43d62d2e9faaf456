// The scene: plain data that describes cloths, their surroundings and which of their
// parameters are to be estimated. SI units throughout (m, kg, s, N), y is up.
#ifndef DPE_ENGINE_SCENE_H_
#define DPE_ENGINE_SCENE_H_

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "dpe/engine/export.h"

namespace dpe {

// Bad input: the message names the file (or "scene"), the place in it, the offending
// value and what is accepted.
class DPE_ENGINE_API SceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The numbers are those of the scene file's `integrationMethod`.
enum class IntegrationMethod {
  kExplicitEuler = 0,
  kSymplecticEuler = 1,
  kLinearlyImplicitEuler = 2,
  kImplicitEuler = 3,
  kTrBdf2 = 4,
};

// Which drag force a triangle feels, see forces/drag.h.
enum class AerodynamicsLaw { kAuthored, kUnitNormal };

enum class SpringKind { kStretch, kShear, kBend };

// How a per-element quantity is estimated: n, G, L, R of `optimizationSettings`.
enum class ParameterMode {
  kFixed,   // n: not estimated
  kGlobal,  // G: one value for the whole object
  kLocal,   // L: one value per element
  kGroup,   // R: one value per group of elements
};

// The numbers are those of the scene file's collider `type`.
enum class ColliderType { kPlane = 0, kSphere = 1 };

struct Collider {
  ColliderType type = ColliderType::kSphere;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();          // m
  Eigen::Vector3d rotation_degrees = Eigen::Vector3d::Zero();  // Euler, Unity order
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();  // m; a sphere's radius is scale.x/2
  double stiffness = 1000.0;                        // N/m
};

// The path of one fixed vertex: column f is its position at frame f; after the last
// column it stands still.
struct PrescribedPath {
  int vertex = -1;
  Eigen::Matrix3Xd positions;  // m

  Eigen::Vector3d At(int frame) const {
    return positions.col(std::min<Eigen::Index>(frame, positions.cols() - 1));
  }
};

struct ClothObject {
  // 3N, xyz interleaved, m; where the motion starts, and the rest shape unless
  // rest_length is given
  Eigen::VectorXd positions;
  Eigen::VectorXd velocities;  // 3N, m/s; initial velocities, zero unless given
  std::vector<char> is_fixed;  // N, 1 where the vertex is not an unknown
  Eigen::VectorXd mass;        // N, kg; positive where the vertex is free

  std::vector<std::array<int, 2>> springs;
  Eigen::VectorXd stiffness;    // one per spring, N/m, >= 0
  Eigen::VectorXd rest_length;  // one per spring, m, > 0, or empty: see RestLengths
  std::vector<SpringKind> spring_kind;  // one per spring, or empty: not given
  std::vector<int> spring_group;        // one per spring, or empty: spring_kind decides
  std::vector<int> vertex_group;        // one per vertex, or empty: one group
  std::vector<std::array<int, 3>> triangles;

  double drag_coefficient = 0.0;  // C of the drag law
  double damping = 0.0;           // alpha (1/s); beta = damping / 2 (s)
  std::vector<PrescribedPath> prescribed_paths;

  ParameterMode mass_mode = ParameterMode::kFixed;
  ParameterMode stiffness_mode = ParameterMode::kFixed;
  bool estimate_damping = false;
  bool estimate_drag = false;
  bool estimate_initial_velocity = false;
  bool estimate_initial_position = false;  // needs rest_length: no parameter moves it

  int num_vertices() const { return static_cast<int>(is_fixed.size()); }
  int num_springs() const { return static_cast<int>(springs.size()); }
};

struct Scene {
  std::string title;
  double delta = 0.02;  // s, length of a frame
  IntegrationMethod integration_method = IntegrationMethod::kLinearlyImplicitEuler;
  double tolerance = 1e-5;  // relative residual, where an iterative solver is used
  int num_frames = 100;     // `optimizationIterations`: frames to fit
  int steps_per_frame = 1;  // `forwardSubSteps`
  bool print_times = false;
  Eigen::Vector3d wind = Eigen::Vector3d::Zero();  // m/s
  Eigen::Vector3d gravity = {0.0, -9.81, 0.0};     // m/s^2
  AerodynamicsLaw aerodynamics = AerodynamicsLaw::kAuthored;
  // How steps are solved: "cholesky" to rounding level, "cg" by a Krylov method to the
  // relative residual `tolerance`; "auto" takes the latter above 10,000 unknowns.
  std::string solver = "auto";
  bool estimate_wind = false;
  std::vector<ClothObject> objects;
  std::vector<Collider> colliders;

  // Length of an integration step, s.
  double step_length() const { return delta / steps_per_frame; }
};

// The letter of `optimizationSettings`: n, G, L or R.
DPE_ENGINE_API char ParameterModeLetter(ParameterMode mode);

// Reads one letter, either case. @throws SceneError naming the letter otherwise.
DPE_ENGINE_API ParameterMode ParameterModeFromLetter(char letter);

// "explicit_euler", "symplectic_euler", "linearly_implicit_euler", "implicit_euler",
// "tr_bdf2".
DPE_ENGINE_API std::string IntegrationMethodName(IntegrationMethod method);

// Accepts a name or the number as text. @throws SceneError naming what is accepted.
DPE_ENGINE_API IntegrationMethod IntegrationMethodFromName(const std::string& name);

// As in scene files: "stretch", "shear", "bend"; "authored", "unit_normal".
DPE_ENGINE_API std::string SpringKindName(SpringKind kind);
DPE_ENGINE_API std::string AerodynamicsLawName(AerodynamicsLaw law);

// Sets the two letters of each object's `optimizationSettings`.
//
// @param settings  two letters per object, separated by commas: "nL,nn". Objects
//                  without an entry are set to "nn" (they are not estimated).
// @param scene     whose objects are changed
// @throws SceneError for a wrong letter, or more entries than objects.
DPE_ENGINE_API void ApplySettings(const std::string& settings, Scene* scene);

// The two letters of every object, separated by commas, trailing "nn" left out.
DPE_ENGINE_API std::string SettingsString(const Scene& scene);

// The rest length of each spring, m: `rest_length`, else the distance of its vertices
// in `positions`.
DPE_ENGINE_API Eigen::VectorXd RestLengths(const ClothObject& object);

// The group of each spring used by mode R: `spring_group`, else one group per kind
// present in `spring_kind`, else all 0.
DPE_ENGINE_API std::vector<int> SpringGroups(const ClothObject& object);

// The group of each vertex used by mode R: `vertex_group`, else all 0.
DPE_ENGINE_API std::vector<int> VertexGroups(const ClothObject& object);

}  // namespace dpe

#endif  // DPE_ENGINE_SCENE_H_
