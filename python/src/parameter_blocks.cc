// Which quantities of a scene are unknown, and where they stand in its parameter
// vector.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <sstream>
#include <string>

#include "arrays.h"
#include "dpe/engine/parameters.h"
#include "module.h"

namespace py = pybind11;

namespace dpe::python {
namespace {

std::string Repr(const ParameterBlock& block) {
  std::ostringstream text;
  text << "<dpe.ParameterBlock " << ParameterKindName(block.kind);
  if (block.object >= 0) text << " of object " << block.object;
  text << ", " << block.size << " in " << ParameterKindUnit(block.kind) << ">";
  return text.str();
}

}  // namespace

void BindParameterBlocks(py::module_& m) {
  py::class_<ParameterBlock>(m, "ParameterBlock",
                             "Unknowns of one kind: where they stand in the parameter "
                             "vector and what they are.")
      .def_property_readonly(
          "kind", [](const ParameterBlock& b) { return ParameterKindName(b.kind); },
          "\"mass\", \"stiffness\", \"damping\", \"drag\", \"wind\", "
          "\"initial_velocity\" or \"initial_position\".")
      .def_property_readonly(
          "unit", [](const ParameterBlock& b) { return ParameterKindUnit(b.kind); },
          "Of its values: \"kg\", \"N/m\", ...")
      .def_property_readonly(
          "mode",
          [](const ParameterBlock& b) {
            return std::string(1, ParameterModeLetter(b.mode));
          },
          "\"G\": one value, \"R\": one per group, \"L\": one per element.")
      .def_readonly("object", &ParameterBlock::object,
                    "Index of the cloth; -1: the scene's own.")
      .def_readonly("offset", &ParameterBlock::offset,
                    "Of its first value in the parameter vector.")
      .def_readonly("size", &ParameterBlock::size, "How many values it has.")
      .def_property_readonly(
          "slice",
          [](const ParameterBlock& b) {
            return py::slice(b.offset, b.offset + b.size, 1);
          },
          "Of the parameter vector: p[block.slice] are its values.")
      .def_property_readonly(
          "element_to_value",
          [](const ParameterBlock& b) {
            return py::array_t<int>(static_cast<py::ssize_t>(b.element_to_local.size()),
                                    b.element_to_local.data());
          },
          "For each vertex or spring its value within the block, int, or -1 for those "
          "without influence on the motion.")
      .def("__repr__", &Repr);
}

}  // namespace dpe::python
