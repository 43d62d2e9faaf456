// dpe.Simulator, dpe.Rollout, dpe.simulate, and derivatives in one call.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "arrays.h"
#include "derivatives.h"
#include "errors.h"
#include "module.h"
#include "simulation.h"

namespace py = pybind11;

namespace dpe::python {
namespace {

using SimulationPointer = std::shared_ptr<Simulation>;

int NumFrames(const Scene& scene, std::optional<int> frames) {
  const int count = frames.value_or(scene.num_frames);
  if (count < 1) {
    throw py::value_error("frames: " + std::to_string(count) +
                          "; accepted are 1 or more (frame 0 is the initial state)");
  }
  return count;
}

Eigen::VectorXd ParametersOr(const Scene& scene, const ParameterLayout& layout,
                             const py::object& parameters) {
  return parameters.is_none()
             ? layout.Extract(scene)
             : VectorFromArray(parameters, "parameters", layout.size());
}

PyTrajectory Simulate(const Scene& given, std::optional<int> frames,
                      const py::object& parameters, int threads, bool check) {
  auto scene = std::make_shared<Scene>(given);
  if (!parameters.is_none()) {
    const ParameterLayout layout(given);
    layout.Insert(VectorFromArray(parameters, "parameters", layout.size()),
                  scene.get());
  }
  const int num_frames = NumFrames(*scene, frames);
  Interrupts interrupts;
  SimulatorOptions options = MakeSimulatorOptions(threads, 0.0);
  options.interrupted = [&interrupts] { return interrupts.Poll(); };
  PyTrajectory result;
  result.scene = scene;
  result.data = CallLong(&interrupts, [&] {
    Simulator simulator(*scene, options);
    return std::make_shared<const Trajectory>(simulator.Simulate(num_frames));
  });
  if (check && !result.data->status.ok()) {
    RaiseSimulationError(result.data->status.Message(), py::cast(result));
  }
  return result;
}

PyRollout RunSimulator(const SimulationPointer& simulation,
                       const py::object& parameters, std::optional<int> frames,
                       bool check) {
  return PyRollout::Run(
      simulation, ParametersOr(simulation->scene(), simulation->layout(), parameters),
      NumFrames(simulation->scene(), frames), check);
}

PyRollout RunOnce(const Scene& scene, const py::object& parameters,
                  std::optional<int> frames, int threads) {
  const auto simulation =
      std::make_shared<Simulation>(scene, MakeSimulatorOptions(threads, 2048.0));
  return RunSimulator(simulation, parameters, frames, /*check=*/true);
}

// As many frames as the derivative has; those of the scene if there is none.
std::optional<int> FramesOf(const py::object& dl_dx, const py::object& dl_dv) {
  for (const py::object& states : {dl_dx, dl_dv}) {
    if (states.is_none()) continue;
    if (!py::isinstance<py::list>(states) && !py::isinstance<py::tuple>(states)) {
      return static_cast<int>(py::len(states));
    }
    for (const py::handle entry : states) {
      if (!entry.is_none()) return static_cast<int>(py::len(entry));
    }
  }
  return std::nullopt;
}

void BindRollout(py::module_& m) {
  py::class_<PyRollout>(m, "Rollout",
                        "A simulation that can be differentiated. Made by "
                        "Simulator.run.")
      .def_property_readonly("trajectory", &PyRollout::trajectory,
                             "What it passed through.")
      .def_property_readonly(
          "positions",
          [](const PyRollout& r) {
            return Motion{r.trajectory(), r.trajectory().OnlyObject()}.positions();
          },
          "trajectory.positions: m, (frames, vertices, 3), read-only, not a copy.")
      .def_property_readonly(
          "velocities",
          [](const PyRollout& r) {
            return Motion{r.trajectory(), r.trajectory().OnlyObject()}.velocities();
          },
          "trajectory.velocities: m/s, likewise.")
      .def_property_readonly(
          "parameters",
          [](const PyRollout& r) { return ToArray(r.rollout().parameters()); },
          "The parameters it was run with, SI units, shape (parameters,).")
      .def_property_readonly(
          "kept_bytes", [](const PyRollout& r) { return r.rollout().kept_bytes(); },
          "What it keeps for derivatives beyond the trajectory.")
      .def("gradient", &Gradient, py::arg("dl_dx"), py::arg("dl_dv") = py::none(),
           "dL/dp, shape (parameters,), of a scalar L of the states by one adjoint "
           "pass. "
           "dl_dx: dL/dx, shape (frames, vertices, 3), L's unit per m; dl_dv: dL/dv, "
           "likewise. Of several objects a list with an array or None for each.")
      .def("jvp", &JacobianVectorProduct, py::arg("dp"),
           "(dx, dv): the change of all positions (m) and velocities (m/s), shape "
           "(frames, vertices, 3), for a change dp of the parameters, by one tangent "
           "pass.")
      .def("jacobian", &PositionJacobian, py::arg("frames") = py::none(),
           py::arg("vertices") = py::none(), py::kw_only(), py::arg("object") = -1,
           py::arg("velocities") = false, py::arg("method") = "auto",
           "dx/dp (or dv/dp) at some frames and vertices, shape (frames, vertices, 3, "
           "parameters), m per unit of the parameter; None: all of them. method: "
           "\"tangent\", \"adjoint\", or \"auto\", the cheaper one. object: -1 for the "
           "only one.");
}

void BindSimulatorClass(py::module_& m) {
  py::class_<Simulation, SimulationPointer>(
      m, "Simulator",
      "Simulates one scene again and again, with different parameters. The scene is "
      "copied: later changes of it are not seen. threads: for independent objects and "
      "the columns of Jacobians; results do not depend on it. memory_limit (MiB): what "
      "a "
      "rollout may keep for its derivatives beyond the trajectory; they make the rest "
      "again, to the same result.")
      .def(py::init([](const Scene& scene, int threads, double memory_limit,
                       bool only_estimated, double newton_tolerance,
                       int max_newton_iterations) {
             SimulatorOptions options = MakeSimulatorOptions(threads, memory_limit);
             options.only_estimated_objects = only_estimated;
             options.newton_tolerance = newton_tolerance;
             options.max_newton_iterations = max_newton_iterations;
             return std::make_shared<Simulation>(scene, options);
           }),
           py::arg("scene"), py::kw_only(), py::arg("threads") = 1,
           py::arg("memory_limit") = 2048.0, py::arg("only_estimated") = false,
           py::arg("newton_tolerance") = 1e-13, py::arg("max_newton_iterations") = 50)
      .def("run", &RunSimulator, py::arg("parameters") = py::none(),
           py::arg("frames") = py::none(), py::kw_only(), py::arg("check") = true,
           "Simulates with these parameters (SI units; None: the scene's). Raises "
           "SimulationError if a frame cannot be reached, unless check is False. The "
           "GIL is released.")
      .def_property_readonly(
          "scene",
          [](const Simulation& s) { return std::make_shared<Scene>(s.scene()); },
          "A copy of the scene.")
      .def_property_readonly(
          "parameters",
          [](const Simulation& s) { return ToArray(s.layout().Extract(s.scene())); },
          "The scene's own parameter vector, SI units, shape (parameters,).")
      .def_property_readonly(
          "parameter_blocks", [](const Simulation& s) { return s.layout().blocks(); },
          "What the parameter vector consists of.");
}

}  // namespace

void BindSimulator(py::module_& m) {
  BindRollout(m);
  BindSimulatorClass(m);
  m.def("simulate", &Simulate, py::arg("scene"), py::arg("frames") = py::none(),
        py::kw_only(), py::arg("parameters") = py::none(), py::arg("threads") = 1,
        py::arg("check") = true,
        "The motion of a scene, a Trajectory: what simulate_cloth writes, bit by bit. "
        "frames: None for the scene's. parameters: SI units, in place of the scene's. "
        "Raises SimulationError if a frame cannot be reached, unless check is False. "
        "The GIL is released; Ctrl-C ends it.");
  m.def(
      "gradient",
      [](const Scene& scene, const py::object& dl_dx, const py::object& dl_dv,
         const py::object& parameters, int threads) {
        PyRollout rollout = RunOnce(scene, parameters, FramesOf(dl_dx, dl_dv), threads);
        return Gradient(&rollout, dl_dx, dl_dv);
      },
      py::arg("scene"), py::arg("dl_dx"), py::arg("dl_dv") = py::none(), py::kw_only(),
      py::arg("parameters") = py::none(), py::arg("threads") = 1,
      "dL/dp of a scalar L of the states, shape (parameters,): Rollout.gradient of a "
      "rollout of as many frames as dl_dx has.");
  m.def(
      "jvp",
      [](const Scene& scene, const py::object& dp, std::optional<int> frames,
         const py::object& parameters, int threads) {
        PyRollout rollout = RunOnce(scene, parameters, frames, threads);
        return JacobianVectorProduct(&rollout, dp);
      },
      py::arg("scene"), py::arg("dp"), py::arg("frames") = py::none(), py::kw_only(),
      py::arg("parameters") = py::none(), py::arg("threads") = 1,
      "(dx, dv): the change of the motion for a change dp of the parameters; "
      "Rollout.jvp of a rollout of its own.");
  m.def(
      "jacobian",
      [](const Scene& scene, std::optional<int> frames, const py::object& at_frames,
         const py::object& vertices, const py::object& parameters, int object,
         bool velocities, const std::string& method, int threads) {
        PyRollout rollout = RunOnce(scene, parameters, frames, threads);
        return PositionJacobian(&rollout, at_frames, vertices, object, velocities,
                                method);
      },
      py::arg("scene"), py::arg("frames") = py::none(), py::kw_only(),
      py::arg("at_frames") = py::none(), py::arg("vertices") = py::none(),
      py::arg("parameters") = py::none(), py::arg("object") = -1,
      py::arg("velocities") = false, py::arg("method") = "auto", py::arg("threads") = 1,
      "dx/dp at some frames and vertices of a rollout of `frames` frames, shape "
      "(at_frames, vertices, 3, parameters); Rollout.jacobian of a rollout of its "
      "own.");
}

}  // namespace dpe::python
