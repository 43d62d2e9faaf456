// Builds cloths: rectangular grids and triangle meshes, with springs, masses and
// stiffnesses by the construction rule stated at BuildClothFromMesh.
#ifndef DPE_ENGINE_CLOTH_BUILDER_H_
#define DPE_ENGINE_CLOTH_BUILDER_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "dpe/engine/export.h"
#include "dpe/engine/scene.h"

namespace dpe {

// Vertices (3N, xyz interleaved, m) and triangles of a mesh.
struct TriangleMesh {
  Eigen::VectorXd positions;
  std::vector<std::array<int, 3>> triangles;
};

// Plane in which a grid cloth stands.
enum class GridPlane {
  kXZ,  // i -> x, j -> z (lying)
  kYZ,  // i -> y, j -> z (standing, as the flags do)
};

// A grid of `cols` (i, fast) x `rows` (j) vertices; vertex index cols * j + i; edges of
// the square have length `size` (m), centred at the origin.
// @throws SceneError for fewer than 2 rows or columns, or a size that is not positive.
DPE_ENGINE_API TriangleMesh MakeGrid(int rows, int cols, double size, GridPlane plane);

// Reads vertices and triangles of a Wavefront OBJ file. Faces are triangulated;
// vertices that belong to no face are left out (they would have no mass), and the
// others keep their order.
// @throws SceneError naming file, line where there is one, and problem.
DPE_ENGINE_API TriangleMesh LoadObjMesh(const std::string& path);

struct ClothMaterial {
  double traction_stiffness = 50.0;  // K of edge springs: k = K vol / L^2, N/m
  double bending_stiffness = 12.5;   // K of bending springs, N/m
  double shear_stiffness = -1.0;     // K of diagonal edges; negative: as traction
  double density = 0.1;              // kg/m^2
  double damping = 0.1;
  double drag_coefficient = 0.1;
};

// Builds a cloth over a mesh.
//
// For each triangle (t0,t1,t2) in order, with area A, its edges (t0,t1) opposite t2,
// (t0,t2) opposite t1, (t1,t2) opposite t0 are visited. A new edge appends a traction
// spring with vol = A. An edge seen before has its vol increased by A and appends at
// once a bending spring between the two opposite vertices, with vol = 2A. The stiffness
// is k = K vol / L^2 with rest length L; the mass of a vertex is the density times a
// third of the areas of its triangles. An edge spring is of kind shear if it is the
// longest edge of all its triangles (a grid's diagonals), otherwise stretch. All
// vertices are free.
//
// @throws SceneError for a mesh without triangles, indices out of range, triangles
//         without area, vertices without a triangle, opposite vertices that coincide,
//         and material constants that are not finite or negative.
DPE_ENGINE_API ClothObject BuildClothFromMesh(const TriangleMesh& mesh,
                                              const ClothMaterial& material);

// Makes the vertices fixed that lie in a closed box (with a margin of 1e-6 of the
// cloth's extent, since corners of a box are typed with few digits).
// @return  how many vertices the box holds
DPE_ENGINE_API int PinBox(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper,
                          ClothObject* cloth);

// Makes vertices fixed. @throws SceneError for an index out of range.
DPE_ENGINE_API void PinVertices(const std::vector<int>& vertices, ClothObject* cloth);

// Makes all vertices free.
DPE_ENGINE_API void UnpinAll(ClothObject* cloth);

// A sphere to collide with. @param radius  m
DPE_ENGINE_API Collider SphereCollider(const Eigen::Vector3d& center, double radius);

// A smooth random field over vertices or spring midpoints: exp(s z), with z a sum of a
// few random cosine waves, zero mean and unit variance over the points. The same seed
// gives the same field with every compiler and standard library.
//
// @param points       3 x n, m
// @param sigma        s, standard deviation of the logarithm
// @param wave_length  shortest wave length, m; the longest is three times as long
// @param seed         of a std::mt19937
// @throws SceneError  for a negative sigma or a wave length that is not positive
DPE_ENGINE_API Eigen::VectorXd SmoothRandomField(const Eigen::Matrix3Xd& points,
                                                 double sigma, double wave_length,
                                                 std::uint32_t seed);

// Spatial variation of a cloth's material, each quantity with a field of its own.
struct MaterialVariation {
  double stiffness_sigma = 0.0;  // of the logarithm of the springs' stiffness
  double mass_sigma = 0.0;       // of the logarithm of the vertices' mass
  double wave_length = 3.5;      // m
  std::uint32_t seed = 1;
};

// Multiplies stiffness (at spring midpoints) and mass (at vertices) by smooth random
// fields. A sigma of zero leaves the quantity as it is.
DPE_ENGINE_API void VaryMaterial(const MaterialVariation& variation,
                                 ClothObject* cloth);

enum class ScenePreset { kSide, kCorners, kFlag, kFlagNoWind };

// The preset of a name: side, corners, flag, flag_no_wind. @throws SceneError
DPE_ENGINE_API ScenePreset ScenePresetFromName(const std::string& name);

struct PresetOptions {
  int rows = 12;
  int cols = 12;
  double size = 7.0;  // m
  ClothMaterial material;
};

// A complete scene of one grid cloth: pins, wind, frames and time step of the preset.
DPE_ENGINE_API Scene MakePresetScene(ScenePreset preset,
                                     const PresetOptions& options = {});

// The preset's wind, frames and time step around a cloth of any shape. Its pins are the
// cloth's own: a preset's pins are rows and corners of a grid.
DPE_ENGINE_API Scene MakeClothScene(ScenePreset preset, ClothObject cloth);

}  // namespace dpe

#endif  // DPE_ENGINE_CLOTH_BUILDER_H_
