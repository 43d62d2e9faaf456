// dpe.TrajectoryCost, dpe.PositionCosts and dpe.check_cost.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dpe/estimation/robust_loss.h"
#include "dpe/estimation/trajectory_cost_check.h"
#include "long_call.h"
#include "module.h"
#include "observations.h"
#include "python_cost.h"
#include "trajectory.h"

namespace py = pybind11;

namespace dpe::python {
namespace {

PyCost MakeCost(int num_residuals, const std::vector<std::pair<int, int>>& states,
                py::function function) {
  if (num_residuals < 1) {
    throw py::value_error("num_residuals: accepted are 1 or more");
  }
  std::vector<TrajectoryCost::StateReference> references;
  for (const auto& [object, frame] : states) {
    if (object < 0 || frame < 0) {
      throw py::value_error("states: (object, frame), both 0 or more");
    }
    references.push_back({object, frame});
  }
  return {std::make_shared<PythonCost>(num_residuals, std::move(references),
                                       std::move(function))};
}

std::vector<PyCost> PositionCosts(const Scene& scene, const py::object& target,
                                  std::optional<int> frames, double sigma,
                                  const std::string& loss, double loss_scale) {
  Observations observations = ObservationsFromPython(target, scene);
  if (sigma > 0.0) observations.sigma = sigma;
  const PositionCostOptions options = {LossTypeFromName(loss), loss_scale};
  std::vector<PyCost> costs;
  for (auto& cost : MakePositionCosts(
           scene, observations, frames.value_or(observations.num_frames()), options)) {
    costs.push_back({CostPointer(std::move(cost))});
  }
  return costs;
}

std::string CheckCost(const PyCost& cost, const PyTrajectory& trajectory,
                      double tolerance) {
  for (const auto& [object, frame] : cost.cost->states()) {
    const auto& positions = trajectory.data->positions;
    if (object >= static_cast<int>(positions.size()) ||
        frame >= positions[object].cols()) {
      throw py::value_error("the cost reads object " + std::to_string(object) +
                            " at frame " + std::to_string(frame) +
                            ", which the trajectory does not hold");
    }
  }
  Interrupts interrupts;
  const TrajectoryCostCheck check = CallLong(&interrupts, [&] {
    return CheckTrajectoryCost(*cost.cost, *trajectory.data, tolerance);
  });
  RethrowErrors({cost.cost});
  if (!check.ok) throw py::value_error(check.message);
  return check.message;
}

}  // namespace

void BindCosts(py::module_& m) {
  py::class_<StateView>(m, "State", "One object's state at one frame, of a residual.")
      .def_readonly("object", &StateView::object, "Index of the object.")
      .def_readonly("frame", &StateView::frame, "From 0, the initial state.")
      .def_readonly("positions", &StateView::positions, "m, shape (vertices, 3).")
      .def_readonly("velocities", &StateView::velocities, "m/s, likewise.");
  py::class_<PyCost>(
      m, "TrajectoryCost",
      "Residuals r on simulated states; a fit minimises 1/2 the sum of their squares. "
      "states: the (object, frame) that it reads. function(states, derivatives) is "
      "called with a list of State and whether derivatives are wanted, and returns r, "
      "shape (num_residuals,), or the tuple (r, dr_dx) or (r, dr_dx, dr_dv): lists "
      "with "
      "an entry for each state, an array (num_residuals, vertices, 3), a scipy.sparse "
      "matrix (num_residuals, 3 vertices), or None where there is no dependence. None "
      "in place of it all, or a number that is not finite, says that the residual "
      "cannot be evaluated there. It may be called from several threads, one at a "
      "time.")
      .def(py::init(&MakeCost), py::arg("num_residuals"), py::arg("states"),
           py::arg("function"))
      .def_property_readonly(
          "num_residuals", [](const PyCost& c) { return c.cost->num_residuals(); },
          "How many numbers it returns.")
      .def_property_readonly(
          "states",
          [](const PyCost& c) {
            std::vector<std::pair<int, int>> states;
            for (const auto& [object, frame] : c.cost->states()) {
              states.emplace_back(object, frame);
            }
            return states;
          },
          "The (object, frame) that it reads.");
  m.def("position_costs", &PositionCosts, py::arg("scene"), py::arg("target"),
        py::arg("frames") = py::none(), py::kw_only(), py::arg("sigma") = 0.0,
        py::arg("loss") = "none", py::arg("loss_scale") = 0.0,
        "The costs that estimate minimises, one per frame: simulated minus observed "
        "positions, in standard deviations of the noise where sigma (m) is known, else "
        "in m. target: an array (frames, vertices, 3), Observations or a Trajectory.");
  m.def(
      "check_cost", &CheckCost, py::arg("cost"), py::arg("trajectory"),
      py::arg("tolerance") = 1e-6,
      "Compares a cost's derivatives with central differences, and sees that it reads "
      "no other states than it says. Returns a sentence of how good they are; raises "
      "ValueError saying what is wrong.");
}

}  // namespace dpe::python
