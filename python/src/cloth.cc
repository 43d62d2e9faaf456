#include "cloth.h"

#include <algorithm>
#include <utility>

#include "arrays.h"

namespace py = pybind11;

namespace dpe::python {
namespace {

py::array View(const Cloth& cloth, const Eigen::VectorXd& vector) {
  return ViewOf(vector.data(), {vector.size()}, cloth.scene, true);
}

py::array VertexView(const Cloth& cloth, const Eigen::VectorXd& vector) {
  return ViewOf(vector.data(), {vector.size() / 3, 3}, cloth.scene, true);
}

// A number for all, or one for each.
void Assign(const py::object& value, const std::string& what, Eigen::VectorXd* vector) {
  if (py::isinstance<py::float_>(value) || py::isinstance<py::int_>(value)) {
    vector->setConstant(value.cast<double>());
  } else {
    *vector = VectorFromArray(value, what, vector->size());
  }
}

void AssignVertices(const py::object& value, const std::string& what,
                    Eigen::VectorXd* vector) {
  const Doubles array = Doubles::ensure(value);
  const py::ssize_t n = vector->size() / 3;
  if (!array) {
    PyErr_Clear();
    throw py::value_error(what + " is not an array of numbers");
  }
  if (array.ndim() != 2 || array.shape(0) != n || array.shape(1) != 3) {
    RefuseShape(what, array, "(" + std::to_string(n) + ", 3)");
  }
  std::copy_n(array.data(), vector->size(), vector->data());
}

std::vector<int> Groups(const py::object& value, const std::string& what, size_t size) {
  if (value.is_none()) return {};
  const Ints array = Ints::ensure(value);
  if (!array || array.ndim() != 1 || array.shape(0) != size) {
    PyErr_Clear();
    throw py::value_error(what + " has to be " + std::to_string(size) +
                          " whole numbers, or None");
  }
  return std::vector<int>(array.data(), array.data() + size);
}

py::array ToIntArray(const std::vector<int>& values) {
  return py::array_t<int>(static_cast<py::ssize_t>(values.size()), values.data());
}

}  // namespace

Cloth ClothOf(const std::shared_ptr<Scene>& scene) {
  if (scene->objects.size() == 1) return {scene, 0};
  throw py::attribute_error("the scene has " + std::to_string(scene->objects.size()) +
                            " objects; this is an attribute of each of scene.objects");
}

py::array Positions(const Cloth& cloth) {
  return VertexView(cloth, cloth.object().positions);
}

void SetPositions(const Cloth& cloth, const py::object& value) {
  AssignVertices(value, "positions", &cloth.object().positions);
}

py::array Velocities(const Cloth& cloth) {
  return VertexView(cloth, cloth.object().velocities);
}

void SetVelocities(const Cloth& cloth, const py::object& value) {
  AssignVertices(value, "velocities", &cloth.object().velocities);
}

py::array Fixed(const Cloth& cloth) {
  static_assert(sizeof(bool) == sizeof(char));
  const std::vector<char>& fixed = cloth.object().is_fixed;
  return ViewOf(reinterpret_cast<const bool*>(fixed.data()),
                {static_cast<py::ssize_t>(fixed.size())}, cloth.scene, true);
}

void SetFixed(const Cloth& cloth, const py::object& value) {
  std::vector<char>& fixed = cloth.object().is_fixed;
  const auto array =
      py::array_t<bool, py::array::c_style | py::array::forcecast>::ensure(value);
  if (!array || array.ndim() != 1 || array.shape(0) != fixed.size()) {
    PyErr_Clear();
    throw py::value_error("fixed has to be " + std::to_string(fixed.size()) +
                          " truth values; scene.pin takes indices");
  }
  for (size_t v = 0; v < fixed.size(); ++v) fixed[v] = array.data()[v] ? 1 : 0;
}

py::array Mass(const Cloth& cloth) { return View(cloth, cloth.object().mass); }

void SetMass(const Cloth& cloth, const py::object& value) {
  Assign(value, "mass", &cloth.object().mass);
}

py::array Stiffness(const Cloth& cloth) {
  return View(cloth, cloth.object().stiffness);
}

void SetStiffness(const Cloth& cloth, const py::object& value) {
  Assign(value, "stiffness", &cloth.object().stiffness);
}

// A copy: whether a scene has rest lengths of its own is for the setter to change, and
// then the vector gets its memory.
py::array RestLength(const Cloth& cloth) {
  py::array array = ToArray(RestLengths(cloth.object()));
  array.attr("flags").attr("writeable") = false;
  return array;
}

void SetRestLength(const Cloth& cloth, const py::object& value) {
  ClothObject& object = cloth.object();
  if (value.is_none()) {
    object.rest_length.resize(0);
  } else {
    object.rest_length = VectorFromArray(value, "rest_length", object.num_springs());
  }
}

py::array Springs(const Cloth& cloth) {
  const auto& springs = cloth.object().springs;
  return ViewOf(reinterpret_cast<const int*>(springs.data()),
                {static_cast<py::ssize_t>(springs.size()), 2}, cloth.scene, true);
}

py::array Triangles(const Cloth& cloth) {
  const auto& triangles = cloth.object().triangles;
  return ViewOf(reinterpret_cast<const int*>(triangles.data()),
                {static_cast<py::ssize_t>(triangles.size()), 3}, cloth.scene, true);
}

py::object SpringKinds(const Cloth& cloth) {
  if (cloth.object().spring_kind.empty()) return py::none();
  py::list kinds;
  for (const SpringKind kind : cloth.object().spring_kind) {
    kinds.append(SpringKindName(kind));
  }
  return py::module_::import("numpy").attr("array")(kinds);
}

py::array SpringGroup(const Cloth& cloth) {
  return ToIntArray(SpringGroups(cloth.object()));
}

void SetSpringGroup(const Cloth& cloth, const py::object& value) {
  cloth.object().spring_group =
      Groups(value, "spring_group", cloth.object().springs.size());
}

py::array VertexGroup(const Cloth& cloth) {
  return ToIntArray(VertexGroups(cloth.object()));
}

void SetVertexGroup(const Cloth& cloth, const py::object& value) {
  cloth.object().vertex_group =
      Groups(value, "vertex_group", cloth.object().is_fixed.size());
}

void Prescribe(const Cloth& cloth, int vertex, const py::object& positions) {
  ClothObject& object = cloth.object();
  if (vertex < 0 || vertex >= object.num_vertices()) {
    throw py::index_error("vertex " + std::to_string(vertex) + "; the cloth has " +
                          std::to_string(object.num_vertices()));
  }
  const Doubles array = Doubles::ensure(positions);
  if (!array || array.ndim() != 2 || array.shape(1) != 3 || array.shape(0) == 0) {
    PyErr_Clear();
    throw py::value_error("a path is an array of shape (frames, 3)");
  }
  PrescribedPath path;
  path.vertex = vertex;
  path.positions = Eigen::Map<const Eigen::Matrix3Xd>(array.data(), 3, array.shape(0));
  auto& paths = object.prescribed_paths;
  const auto is_this = [&](const PrescribedPath& p) { return p.vertex == vertex; };
  paths.erase(std::remove_if(paths.begin(), paths.end(), is_this), paths.end());
  paths.push_back(std::move(path));
  object.is_fixed[vertex] = 1;
  object.positions.segment<3>(3 * vertex) = paths.back().positions.col(0);
}

}  // namespace dpe::python
