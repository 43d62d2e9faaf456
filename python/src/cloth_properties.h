// The attributes that a cloth has, and a scene that consists of one.
#ifndef DPE_PYTHON_CLOTH_PROPERTIES_H_
#define DPE_PYTHON_CLOTH_PROPERTIES_H_

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "arrays.h"
#include "cloth.h"
#include "dpe/engine/cloth_builder.h"

namespace dpe::python {

// @param Self  Cloth, or std::shared_ptr<Scene>: what ClothOf takes
template <class Self, class Class>
class ClothProperties {
 public:
  explicit ClothProperties(Class* type) : type_(*type) {}

  void BindAll() {
    BindVertices();
    BindElements();
    BindConstants();
    BindPins();
  }

 private:
  using Value = pybind11::object;

  template <class Result>
  void Get(const char* name, Result (*get)(const Cloth&), const char* doc) {
    type_.def_property_readonly(
        name, [get](const Self& self) { return get(ClothOf(self)); }, doc);
  }

  template <class Result>
  void GetSet(const char* name, Result (*get)(const Cloth&),
              void (*set)(const Cloth&, const Value&), const char* doc) {
    type_.def_property(
        name, [get](const Self& self) { return get(ClothOf(self)); },
        [set](const Self& self, const Value& value) { set(ClothOf(self), value); },
        doc);
  }

  template <class Member>
  void Field(const char* name, Member ClothObject::*member, const char* doc) {
    type_.def_property(
        name, [member](const Self& self) { return ClothOf(self).object().*member; },
        [member](const Self& self, Member value) {
          ClothOf(self).object().*member = value;
        },
        doc);
  }

  void BindVertices() {
    GetSet("positions", &Positions, &SetPositions,
           "Where the motion starts, m, shape (vertices, 3); the rest shape, too, "
           "unless rest_length was set. A view: writing into it changes the scene.");
    GetSet("velocities", &Velocities, &SetVelocities,
           "Initial velocities, m/s, shape (vertices, 3). A view.");
    GetSet("fixed", &Fixed, &SetFixed,
           "Whether each vertex is held where it is (or on its prescribed path), bool, "
           "shape (vertices,). A view.");
    GetSet("mass", &Mass, &SetMass,
           "Of each vertex, kg, shape (vertices,). A view; a number may be assigned "
           "for all.");
    GetSet("vertex_group", &VertexGroup, &SetVertexGroup,
           "The group of each vertex for mode R, int, shape (vertices,). A copy; None "
           "may be assigned: one group.");
  }

  void BindElements() {
    Get("springs", &Springs,
        "The two vertices of each spring, int32, shape (springs, 2). A view.");
    GetSet(
        "stiffness", &Stiffness, &SetStiffness,
        "Of each spring, N/m, shape (springs,). A view; a number may be assigned for "
        "all.");
    GetSet(
        "rest_length", &RestLength, &SetRestLength,
        "Of each spring, m, shape (springs,): what was set, else the distance of its "
        "vertices in positions. A read-only copy; assign to change it, None to "
        "follow positions again.");
    Get("spring_kind", &SpringKinds,
        "\"stretch\", \"shear\" or \"bend\" of each spring, shape (springs,), or "
        "None.");
    GetSet("spring_group", &SpringGroup, &SetSpringGroup,
           "The group of each spring for mode R, int, shape (springs,): what was set, "
           "else one group per kind. A copy; None may be assigned.");
    Get("triangles", &Triangles,
        "The three vertices of each triangle, int32, shape (triangles, 3). A view.");
  }

  void BindConstants() {
    Field("damping", &ClothObject::damping, "alpha, 1/s; beta is half of it (s).");
    Field("drag", &ClothObject::drag_coefficient, "Coefficient of the drag law.");
    Field("estimate_damping", &ClothObject::estimate_damping,
          "Whether damping is unknown.");
    Field("estimate_drag", &ClothObject::estimate_drag,
          "Whether the drag coefficient is unknown.");
    Field("estimate_initial_velocity", &ClothObject::estimate_initial_velocity,
          "Whether the initial velocities are unknown.");
    Field("estimate_initial_position", &ClothObject::estimate_initial_position,
          "Whether the initial positions are unknown; needs rest_length.");
  }

  void BindPins() {
    namespace py = pybind11;
    type_.def(
        "pin",
        [](const Self& self, const std::vector<int>& vertices) {
          PinVertices(vertices, &ClothOf(self).object());
        },
        py::arg("vertices"), "Makes vertices fixed, by their indices.");
    type_.def(
        "pin_box",
        [](const Self& self, const Value& lower, const Value& upper) {
          return PinBox(VectorFromArray(lower, "lower", 3),
                        VectorFromArray(upper, "upper", 3), &ClothOf(self).object());
        },
        py::arg("lower"), py::arg("upper"),
        "Makes the vertices fixed that lie in a box, m; returns how many it holds.");
    type_.def(
        "unpin_all", [](const Self& self) { UnpinAll(&ClothOf(self).object()); },
        "Makes all vertices free.");
    type_.def(
        "prescribe",
        [](const Self& self, int vertex, const Value& positions) {
          Prescribe(ClothOf(self), vertex, positions);
        },
        py::arg("vertex"), py::arg("positions"),
        "Moves a vertex along a path: its position at each frame, m, shape (frames, "
        "3); after the last it stands still. The vertex becomes fixed.");
    type_.def(
        "vary_material",
        [](const Self& self, double stiffness_sigma, double mass_sigma,
           double wave_length, std::uint32_t seed) {
          VaryMaterial({stiffness_sigma, mass_sigma, wave_length, seed},
                       &ClothOf(self).object());
        },
        py::kw_only(), py::arg("stiffness_sigma") = 0.0, py::arg("mass_sigma") = 0.0,
        py::arg("wave_length") = 3.5, py::arg("seed") = 1,
        "Multiplies stiffness and mass by smooth random fields exp(sigma z) of this "
        "shortest wave length (m).");
  }

  Class& type_;
};

}  // namespace dpe::python

#endif  // DPE_PYTHON_CLOTH_PROPERTIES_H_
