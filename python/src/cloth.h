// One cloth of a scene that Python holds.
//
// Arrays are views of the scene's own numbers: writing into them changes the scene, and
// they keep it alive. That is safe because nothing that Python can do changes the
// number of a cloth's vertices, springs or triangles, or takes a cloth out of its
// scene: assignments copy into the memory that is there. Adding a cloth moves the
// others, and a moved Eigen or std vector keeps its memory.
#ifndef DPE_PYTHON_CLOTH_H_
#define DPE_PYTHON_CLOTH_H_

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <type_traits>

#include "dpe/engine/scene.h"

namespace dpe::python {

static_assert(std::is_nothrow_move_constructible_v<ClothObject>);

struct Cloth {
  std::shared_ptr<Scene> scene;
  int index = 0;

  ClothObject& object() const { return scene->objects[index]; }
};

inline const Cloth& ClothOf(const Cloth& cloth) { return cloth; }

// The scene's only cloth. @throws AttributeError if there are none or several
Cloth ClothOf(const std::shared_ptr<Scene>& scene);

// Getters and setters; see cloth_properties.h for which.
pybind11::array Positions(const Cloth& cloth);
void SetPositions(const Cloth& cloth, const pybind11::object& value);
pybind11::array Velocities(const Cloth& cloth);
void SetVelocities(const Cloth& cloth, const pybind11::object& value);
pybind11::array Fixed(const Cloth& cloth);
void SetFixed(const Cloth& cloth, const pybind11::object& value);
pybind11::array Mass(const Cloth& cloth);
void SetMass(const Cloth& cloth, const pybind11::object& value);
pybind11::array Stiffness(const Cloth& cloth);
void SetStiffness(const Cloth& cloth, const pybind11::object& value);
pybind11::array RestLength(const Cloth& cloth);
void SetRestLength(const Cloth& cloth, const pybind11::object& value);
pybind11::array Springs(const Cloth& cloth);
pybind11::array Triangles(const Cloth& cloth);
pybind11::object SpringKinds(const Cloth& cloth);
pybind11::array SpringGroup(const Cloth& cloth);
void SetSpringGroup(const Cloth& cloth, const pybind11::object& value);
pybind11::array VertexGroup(const Cloth& cloth);
void SetVertexGroup(const Cloth& cloth, const pybind11::object& value);
void Prescribe(const Cloth& cloth, int vertex, const pybind11::object& positions);

}  // namespace dpe::python

#endif  // DPE_PYTHON_CLOTH_H_
