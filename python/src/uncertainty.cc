// dpe.Uncertainty: error bars, and what the data did not determine.
#include "dpe/estimation/uncertainty.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "arrays.h"
#include "module.h"

namespace py = pybind11;

namespace dpe::python {
namespace {

void BindBlock(py::module_& m) {
  using Block = BlockUncertainty;
  py::class_<Block>(m, "BlockUncertainty", "Error bars of the values of one block.")
      .def_readonly("object", &Block::object,
                    "Index of the cloth; -1: the scene's own.")
      .def_readonly("kind", &Block::kind, "\"mass\", \"stiffness\", ...")
      .def_readonly("unit", &Block::unit, "Of values and standard deviations.")
      .def_property_readonly(
          "values", [](const Block& b) { return ToArray(b.values); },
          "SI units, shape (n,).")
      .def_property_readonly(
          "standard_deviations",
          [](const Block& b) { return ToArray(b.standard_deviations); },
          "SI units, shape (n,); infinite: undetermined.")
      .def_property_readonly(
          "relative", [](const Block& b) { return ToArray(b.relative); },
          "Standard deviation / value, shape (n,); NaN where the quantity is not "
          "positive by nature.")
      .def_property_readonly(
          "flags",
          [](const Block& b) {
            std::vector<std::vector<std::string>> names;
            for (const unsigned flags : b.flags) {
              names.push_back(ParameterFlagNames(flags));
            }
            return names;
          },
          "What is to be said of each value: \"undetermined\", \"weakly_determined\", "
          "...");
}

void BindDirection(py::module_& m) {
  using Direction = UndeterminedDirection;
  py::class_<Direction>(m, "UndeterminedDirection",
                        "A direction in which the data do not fix the parameters.")
      .def_readonly("is_exact", &Direction::is_exact,
                    "To rounding; False: weakly determined.")
      .def_property_readonly(
          "pattern", [](const Direction& d) { return DirectionPatternName(d.pattern); },
          "\"single\", \"ratio\", \"product\", ...")
      .def_readonly("parameters", &Direction::parameters,
                    "Indices of the largest parts, largest first.")
      .def_readonly("coefficients", &Direction::coefficients,
                    "These parts, relative to the largest.")
      .def_readonly("std", &Direction::std,
                    "Standard deviation of the largest part along it, natural units.")
      .def_readonly("text", &Direction::text, "One sentence.");
}

}  // namespace

void BindUncertainty(py::module_& m) {
  BindBlock(m);
  BindDirection(m);
  using U = Uncertainty;
  py::class_<U>(m, "Uncertainty", "How well the data determine the parameters.")
      .def_readonly("ok", &U::ok, "Whether it was computed.")
      .def_readonly("message", &U::message, "Why not.")
      .def_readonly("noise_is_known", &U::noise_is_known,
                    "Whether residuals are in standard deviations of the noise.")
      .def_readonly("noise", &U::noise,
                    "Standard deviation used for residuals: 1, or in m, estimated.")
      .def_readonly("degrees_of_freedom", &U::degrees_of_freedom,
                    "Residuals less determined directions.")
      .def_readonly("reduced_chi_square", &U::reduced_chi_square,
                    "About 1 if model and noise are right; NaN: noise not known.")
      .def_readonly("residual_correlation", &U::residual_correlation,
                    "Of successive frames, if it is more than chance; else 0.")
      .def_readonly("rank", &U::rank, "Of the data's Jacobian.")
      .def_readonly("names", &U::names, "Of all parameters.")
      .def_readonly("blocks", &U::blocks, "Error bars by block.")
      .def_property_readonly(
          "covariance", [](const U& u) { return ToArray(u.covariance); },
          "Of the optimiser's coordinates (logarithms of positive quantities), shape "
          "(parameters, parameters); empty for very many.")
      .def_property_readonly(
          "correlation", [](const U& u) { return ToArray(u.correlation); },
          "Likewise; NaN for undetermined parameters.")
      .def_readonly("directions", &U::directions,
                    "What was not, or hardly, determined; exact ones first.")
      .def_readonly("statements", &U::statements,
                    "What is to be said of all this, in sentences.")
      .def("__str__", [](const U& u) {
        std::string text;
        for (const std::string& line : UncertaintyLines(u)) text += line + "\n";
        return text;
      });
}

}  // namespace dpe::python
