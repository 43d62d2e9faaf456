// dpe.inverse_dynamics: parameters from complete positions, without a simulation.
#include "dpe/estimation/inverse_dynamics.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <vector>

#include "arrays.h"
#include "dpe/engine/simulator.h"
#include "long_call.h"
#include "module.h"
#include "observations.h"

namespace py = pybind11;

namespace dpe::python {
namespace {

std::vector<double> FreeMasses(const Scene& scene) {
  std::vector<double> masses;
  for (const ClothObject& cloth : scene.objects) {
    double sum = 0.0;
    for (int v = 0; v < cloth.num_vertices(); ++v) {
      if (cloth.is_fixed[v] == 0) sum += cloth.mass[v];
    }
    masses.push_back(sum);
  }
  return masses;
}

InverseDynamicsResult Solve(const Scene& scene, const py::object& target,
                            std::optional<int> frames,
                            const std::optional<std::vector<double>>& total_mass) {
  const Observations observations = ObservationsFromPython(target, scene);
  const std::vector<double> masses = total_mass.value_or(FreeMasses(scene));
  if (masses.size() != scene.objects.size()) {
    throw py::value_error("total_mass: expected one number (kg) per object");
  }
  SimulatorOptions options;
  options.only_estimated_objects = true;
  Simulator simulator(scene, options);
  Interrupts interrupts;
  return CallLong(&interrupts, [&] {
    return SolveInverseDynamics(&simulator, observations,
                                frames.value_or(observations.num_frames()), masses);
  });
}

}  // namespace

void BindInverseDynamics(py::module_& m) {
  using Result = InverseDynamicsResult;
  py::class_<Result>(m, "InverseDynamics", "What dpe.inverse_dynamics found.")
      .def_readonly("ok", &Result::ok, "Whether there is an answer.")
      .def_readonly("message", &Result::message, "Why not.")
      .def_property_readonly(
          "parameters", [](const Result& r) { return ToArray(r.parameters); },
          "In the order of scene.parameter_blocks, SI units, shape (parameters,).")
      .def_readonly("residual_norm", &Result::residual_norm,
                    "Of all step equations at the solution, kg m/s.")
      .def_readonly(
          "undetermined", &Result::undetermined,
          "Indices of the parameters that the motion does not determine; they "
          "take their block's median.")
      .def_readonly("notes", &Result::notes, "Gauges fixed, values clamped, ...");
  m.def(
      "inverse_dynamics", &Solve, py::arg("scene"), py::arg("positions"),
      py::arg("frames") = py::none(), py::kw_only(), py::arg("total_mass") = py::none(),
      "Solves the equations of motion for the scene's unknowns, by least squares. "
      "positions: m, (frames, vertices, 3), complete; exact but for rounding with one "
      "step per frame and exact positions. total_mass (kg, one per object): of the "
      "free vertices, kept where no known force fixes the scale; None: the scene's. "
      "Raises SceneError if a free vertex was not seen at some frame.");
}

}  // namespace dpe::python
