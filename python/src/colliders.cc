#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>

#include <string>

#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/scene.h"
#include "module.h"

namespace py = pybind11;

namespace dpe::python {
namespace {

Collider Sphere(const Eigen::Vector3d& center, double radius, double stiffness) {
  Collider collider = SphereCollider(center, radius);
  collider.stiffness = stiffness;
  return collider;
}

Collider Plane(const Eigen::Vector3d& position, const Eigen::Vector3d& rotation,
               double stiffness) {
  Collider collider;
  collider.type = ColliderType::kPlane;
  collider.position = position;
  collider.rotation_degrees = rotation;
  collider.stiffness = stiffness;
  return collider;
}

}  // namespace

void BindColliders(py::module_& m) {
  py::class_<Collider>(m, "Collider", "Something that the cloth collides with.")
      .def_static("sphere", &Sphere, py::arg("center"), py::arg("radius"),
                  py::arg("stiffness") = 1000.0,
                  "A sphere; center and radius in m, stiffness of the contact in N/m.")
      .def_static("plane", &Plane, py::arg("position"), py::arg("rotation"),
                  py::arg("stiffness") = 1000.0,
                  "A plane through position (m), facing up before it is rotated by "
                  "these Euler angles (degrees, in Unity's order).")
      .def_property_readonly(
          "type",
          [](const Collider& c) {
            return c.type == ColliderType::kPlane ? "plane" : "sphere";
          },
          "\"plane\" or \"sphere\".")
      .def_readwrite("position", &Collider::position, "m, shape (3,).")
      .def_readwrite("rotation", &Collider::rotation_degrees,
                     "Euler angles, degrees, shape (3,).")
      .def_readwrite("scale", &Collider::scale,
                     "m, shape (3,); a sphere's radius is half the first.")
      .def_readwrite("stiffness", &Collider::stiffness, "N/m.")
      .def("__repr__", [](const Collider& c) {
        return std::string("<dpe.Collider ") +
               (c.type == ColliderType::kPlane ? "plane>" : "sphere>");
      });
}

}  // namespace dpe::python
