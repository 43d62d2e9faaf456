#include "estimate_options.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

#include "arrays.h"

namespace py = pybind11;

namespace dpe::python {
namespace {

using Setter = std::function<void(const py::object&, EstimationJob*)>;
using Setters = std::map<std::string, Setter>;

std::string PathText(const py::object& value) {
  return value.is_none() ? "" : value.cast<std::filesystem::path>().string();
}

double AtLeast(const py::object& value, double least) {
  const double number = value.cast<double>();
  if (number >= least) return number;
  std::ostringstream text;
  text << number << " is not accepted; expected at least " << least;
  throw py::value_error(text.str());
}

int IntAtLeast(const py::object& value, int least) {
  const int number = value.cast<int>();
  if (number >= least) return number;
  throw py::value_error(std::to_string(number) +
                        " is not accepted; expected at least " + std::to_string(least));
}

// The value that goes with a name.
template <class T>
T Choose(const py::object& value,
         const std::vector<std::pair<std::string, T>>& choices) {
  const std::string name = value.cast<std::string>();
  std::string accepted;
  for (const auto& [choice, result] : choices) {
    if (name == choice) return result;
    accepted += (accepted.empty() ? "" : ", ") + choice;
  }
  throw SceneError("\"" + name + "\" is not accepted; expected one of " + accepted);
}

void SetInit(const py::object& value, EstimatorOptions* options) {
  if (!py::isinstance<py::str>(value)) {
    options->start = VectorFromArray(value, "init", -1);
    return;
  }
  const std::string name = value.cast<std::string>();
  constexpr char kUniform[] = "uniform:";
  if (name.rfind(kUniform, 0) != 0) {
    options->init =
        Choose<InitMethod>(value, {{"auto", InitMethod::kAuto},
                                   {"inverse_dynamics", InitMethod::kInverseDynamics},
                                   {"scene", InitMethod::kScene},
                                   {"screen", InitMethod::kScreen}});
    return;
  }
  options->init = InitMethod::kUniform;
  const py::str number = name.substr(sizeof(kUniform) - 1);
  options->uniform_value = py::float_(number).cast<double>();
  if (!(options->uniform_value > 0.0)) {
    throw SceneError("\"" + name + "\": expected a number above 0 after uniform:");
  }
}

std::vector<std::string> Names(const py::object& value) {
  if (value.is_none()) return {};
  if (!py::isinstance<py::str>(value)) return value.cast<std::vector<std::string>>();
  std::vector<std::string> names;
  std::istringstream text(value.cast<std::string>());
  for (std::string name; std::getline(text, name, ',');) names.push_back(name);
  return names;
}

void SetPins(const py::object& value, SceneFromTargetOptions* options) {
  if (value.is_none()) {
    options->without_pins = true;
  } else if (!py::isinstance<py::str>(value)) {
    options->pins = value.cast<std::vector<int>>();
    options->without_pins = options->pins.empty();
  } else if (value.cast<std::string>() != "still") {
    throw SceneError("expected \"still\", indices of vertices, or None");
  }
}

Setters TargetSetters() {
  return {
      {"target_scale",
       [](auto& v, auto* j) { j->target.capture.scale = AtLeast(v, 0.0); }},
      {"target_up",
       [](auto& v, auto* j) {
         j->target.capture.up = UpAxisFromName(v.template cast<std::string>());
       }},
      {"target_rate",
       [](auto& v, auto* j) { j->target.capture.rate = AtLeast(v, 0.0); }},
      {"target_origin",
       [](auto& v, auto* j) {
         j->target.capture.origin = TimeOriginFromName(v.template cast<std::string>());
       }},
      {"target_nan_is_missing",
       [](auto& v, auto* j) {
         j->target.capture.nan_is_missing = v.template cast<bool>();
       }},
      {"target_attach",
       [](auto& v, auto* j) {
         j->target.attach.method = AttachMethodFromName(v.template cast<std::string>());
       }},
      {"target_object",
       [](auto& v, auto* j) { j->target.attach.object = IntAtLeast(v, -1); }},
      {"marker_map", [](auto& v, auto* j) { j->target.marker_map = PathText(v); }},
      {"marker_limit",
       [](auto& v, auto* j) { j->target.attach.max_distance = AtLeast(v, 0.0); }},
      {"follow_pins",
       [](auto& v, auto* j) { j->target.follow_pins = v.template cast<bool>(); }},
      {"initial_state",
       [](auto& v, auto* j) {
         j->target.start_from_target =
             Choose<bool>(v, {{"scene", false}, {"target", true}});
       }},
      {"rest_shape", [](auto& v, auto* j) { j->target.rest_shape = PathText(v); }},
      {"density",
       [](auto& v, auto* j) {
         j->scene_from_target.material.density = AtLeast(v, 0.0);
       }},
      {"pin_vertices", [](auto& v, auto* j) { SetPins(v, &j->scene_from_target); }},
      {"integrator",
       [](auto& v, auto* j) {
         j->scene_from_target.integration_method =
             IntegrationMethodFromName(py::str(v));
       }},
      {"steps_per_frame",
       [](auto& v, auto* j) {
         j->scene_from_target.steps_per_frame = IntAtLeast(v, 1);
       }},
  };
}

Setters ProblemSetters() {
  return {
      {"settings",
       [](auto& v, auto* j) {
         if (!v.is_none()) j->settings = v.template cast<std::string>();
       }},
      {"estimate", [](auto& v, auto* j) { j->estimate = Names(v); }},
      {"frames",
       [](auto& v, auto* j) { j->num_frames = v.is_none() ? 0 : IntAtLeast(v, 2); }},
      {"validate_frames",
       [](auto& v, auto* j) { j->num_validation_frames = IntAtLeast(v, 0); }},
      {"noise_sigma", [](auto& v, auto* j) { j->noise_sigma = AtLeast(v, 0.0); }},
      {"seed",
       [](auto& v, auto* j) {
         j->noise_seed = j->options.seed = v.template cast<std::uint64_t>();
       }},
      {"sigma", [](auto& v, auto* j) { j->sigma = AtLeast(v, 0.0); }},
      {"loss",
       [](auto& v, auto* j) {
         j->options.loss = LossTypeFromName(v.template cast<std::string>());
       }},
      {"loss_scale", [](auto& v, auto* j) { j->options.loss_scale = AtLeast(v, 0.0); }},
      {"prior",
       [](auto& v, auto* j) {
         j->options.priors = PriorsFromText(v.template cast<std::string>());
       }},
      {"smoothness",
       [](auto& v, auto* j) {
         j->options.smoothness = SmoothnessFromText(v.template cast<std::string>());
       }},
  };
}

Setters SolverSetters() {
  return {
      {"init", [](auto& v, auto* j) { SetInit(v, &j->options); }},
      {"init_perturbation",
       [](auto& v, auto* j) { j->options.init_perturbation = AtLeast(v, 0.0); }},
      {"solver",
       [](auto& v, auto* j) {
         j->options.solver =
             Choose<SolverType>(v, {{"auto", SolverType::kAuto},
                                    {"lm", SolverType::kLevenbergMarquardt},
                                    {"lbfgs", SolverType::kLbfgs}});
       }},
      {"jacobian",
       [](auto& v, auto* j) {
         j->options.jacobian =
             Choose<JacobianMethod>(v, {{"auto", JacobianMethod::kAuto},
                                        {"adjoint", JacobianMethod::kAdjoint},
                                        {"tangent", JacobianMethod::kTangent}});
       }},
      {"horizon",
       [](auto& v, auto* j) {
         j->options.horizon = Choose<Horizon>(v, {{"auto", Horizon::kAuto},
                                                  {"full", Horizon::kFull},
                                                  {"grow", Horizon::kGrow},
                                                  {"shooting", Horizon::kShooting}});
       }},
      {"uncertainty",
       [](auto& v, auto* j) {
         j->options.uncertainty =
             Choose<UncertaintyMode>(v, {{"auto", UncertaintyMode::kAuto},
                                         {"on", UncertaintyMode::kOn},
                                         {"off", UncertaintyMode::kOff}});
       }},
      {"max_iterations",
       [](auto& v, auto* j) {
         j->options.max_iterations = v.is_none() ? -1 : IntAtLeast(v, 0);
       }},
      {"max_seconds",
       [](auto& v, auto* j) {
         if (!v.is_none()) j->options.max_seconds = AtLeast(v, 0.0);
       }},
      {"checkpoint",
       [](auto& v, auto* j) { j->options.checkpoint_path = PathText(v); }},
      {"resume", [](auto& v, auto* j) { j->options.resume_path = PathText(v); }},
      {"threads", [](auto& v, auto* j) { j->options.num_threads = IntAtLeast(v, 1); }},
      {"memory_limit",
       [](auto& v, auto* j) {
         j->options.memory_limit_bytes =
             static_cast<std::size_t>(AtLeast(v, 0.0) * (1 << 20));
       }},
  };
}

const Setters& AllSetters() {
  static const Setters* const all = [] {
    auto* setters = new Setters(TargetSetters());
    setters->merge(ProblemSetters());
    setters->merge(SolverSetters());
    return setters;
  }();
  return *all;
}

}  // namespace

void SetEstimateOptions(const py::dict& options, EstimationJob* job) {
  for (const auto& [key, value] : options) {
    const std::string name = py::str(key);
    const auto setter = AllSetters().find(name);
    if (setter == AllSetters().end()) {
      throw py::type_error("estimate: \"" + name + "\" is not an option");
    }
    try {
      setter->second(py::reinterpret_borrow<py::object>(value), job);
    } catch (const SceneError& error) {
      throw SceneError(name + ": " + error.what());
    } catch (const py::value_error& error) {
      throw py::value_error(name + ": " + error.what());
    } catch (const py::cast_error&) {
      throw py::type_error(name + ": " + py::repr(value).cast<std::string>() +
                           " is of a type that is not accepted");
    }
  }
}

}  // namespace dpe::python
