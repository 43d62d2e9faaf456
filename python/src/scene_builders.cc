#include "scene_builders.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/scene_io.h"

namespace py = pybind11;

namespace dpe::python {
namespace {

ClothMaterial Material(double traction, double bending, std::optional<double> shear,
                       double density, double damping, double drag) {
  ClothMaterial material;
  material.traction_stiffness = traction;
  material.bending_stiffness = bending;
  material.shear_stiffness = shear.value_or(-1.0);
  material.density = density;
  material.damping = damping;
  material.drag_coefficient = drag;
  return material;
}

// Without the wind, and with the frames and the time step of the preset "side".
std::shared_ptr<Scene> SceneOf(const TriangleMesh& mesh, const ClothMaterial& material,
                               const std::vector<int>& pins) {
  ClothObject cloth = BuildClothFromMesh(mesh, material);
  PinVertices(pins, &cloth);
  return std::make_shared<Scene>(MakeClothScene(ScenePreset::kSide, std::move(cloth)));
}

TriangleMesh MeshFromArrays(const py::object& positions, const py::object& triangles) {
  const Doubles points = Doubles::ensure(positions);
  const Ints corners = Ints::ensure(triangles);
  if (!points || !corners) {
    PyErr_Clear();
    throw py::value_error("a mesh is positions (vertices, 3) and triangles (n, 3)");
  }
  if (points.ndim() != 2 || points.shape(1) != 3) {
    RefuseShape("positions", points, "(vertices, 3)");
  }
  if (corners.ndim() != 2 || corners.shape(1) != 3) {
    RefuseShape("triangles", corners, "(triangles, 3)");
  }
  TriangleMesh mesh;
  mesh.positions = Eigen::Map<const Eigen::VectorXd>(points.data(), points.size());
  for (py::ssize_t t = 0; t < corners.shape(0); ++t) {
    const int* c = corners.data(t, 0);
    mesh.triangles.push_back({c[0], c[1], c[2]});
  }
  return mesh;
}

GridPlane PlaneFromName(const std::string& name) {
  if (name == "xz") return GridPlane::kXZ;
  if (name == "yz") return GridPlane::kYZ;
  throw SceneError("plane: \"" + name + "\" is not accepted; expected xz or yz");
}

}  // namespace

// The material's arguments are the same everywhere.
#define DPE_MATERIAL_ARGUMENTS                                               \
  py::arg("traction_stiffness") = 50.0, py::arg("bending_stiffness") = 12.5, \
  py::arg("shear_stiffness") = py::none(), py::arg("density") = 0.1,         \
  py::arg("damping") = 0.1, py::arg("drag") = 0.1

void BindSceneBuilders(SceneClass* type) {
  type->def_static(
      "preset",
      [](const std::string& name, int rows, int cols, double size, double traction,
         double bending, std::optional<double> shear, double density, double damping,
         double drag) {
        return std::make_shared<Scene>(MakePresetScene(
            ScenePresetFromName(name),
            {rows, cols, size,
             Material(traction, bending, shear, density, damping, drag)}));
      },
      py::arg("name"), py::kw_only(), py::arg("rows") = 12, py::arg("cols") = 12,
      py::arg("size") = 7.0, DPE_MATERIAL_ARGUMENTS,
      "A grid cloth with the pins, wind, frames and time step of a preset: \"side\", "
      "\"corners\", \"flag\" or \"flag_no_wind\". Size in m, stiffnesses K in N/m (a "
      "spring's is K area / length^2; shear None: as traction), density in kg/m^2.");
  type->def_static(
      "grid",
      [](int rows, int cols, double size, const std::string& plane,
         const std::vector<int>& pins, double traction, double bending,
         std::optional<double> shear, double density, double damping, double drag) {
        return SceneOf(MakeGrid(rows, cols, size, PlaneFromName(plane)),
                       Material(traction, bending, shear, density, damping, drag),
                       pins);
      },
      py::arg("rows") = 12, py::arg("cols") = 12, py::arg("size") = 7.0, py::kw_only(),
      py::arg("plane") = "xz", py::arg("pins") = std::vector<int>(),
      DPE_MATERIAL_ARGUMENTS,
      "A square cloth of rows x cols vertices (vertex cols * j + i) in the plane "
      "\"xz\" "
      "or \"yz\", centred at the origin, without wind. `pins` are indices of vertices. "
      "The material is as for preset().");
  type->def_static(
      "from_mesh",
      [](const py::object& positions, const py::object& triangles,
         const std::vector<int>& pins, double traction, double bending,
         std::optional<double> shear, double density, double damping, double drag) {
        return SceneOf(MeshFromArrays(positions, triangles),
                       Material(traction, bending, shear, density, damping, drag),
                       pins);
      },
      py::arg("positions"), py::arg("triangles"), py::kw_only(),
      py::arg("pins") = std::vector<int>(), DPE_MATERIAL_ARGUMENTS,
      "A cloth over a triangle mesh: positions (vertices, 3) in m, triangles (n, 3). "
      "The material is as for preset().");
  type->def_static(
      "from_obj",
      [](const std::filesystem::path& path, const std::vector<int>& pins,
         double traction, double bending, std::optional<double> shear, double density,
         double damping, double drag) {
        return SceneOf(LoadObjMesh(path.string()),
                       Material(traction, bending, shear, density, damping, drag),
                       pins);
      },
      py::arg("path"), py::kw_only(), py::arg("pins") = std::vector<int>(),
      DPE_MATERIAL_ARGUMENTS,
      "A cloth over the mesh of a Wavefront OBJ file (m). The material is as for "
      "preset().");
}

#undef DPE_MATERIAL_ARGUMENTS

}  // namespace dpe::python
