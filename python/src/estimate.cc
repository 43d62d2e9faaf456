// dpe._core.estimate; what it is called with is said in python/dpe/_estimate.py.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "dpe/engine/scene_io.h"
#include "dpe/estimation/estimation_job.h"
#include "dpe/estimation/scene_from_target.h"
#include "errors.h"
#include "estimate_options.h"
#include "estimate_result.h"
#include "long_call.h"
#include "module.h"
#include "observations.h"

namespace py = pybind11;

namespace dpe::python {
namespace {

bool IsPath(const py::handle& value) {
  return py::isinstance<py::str>(value) || py::hasattr(value, "__fspath__");
}

// All paths or all in memory.
bool ArePaths(const py::list& values, const std::string& what) {
  size_t count = 0;
  for (const py::handle value : values) count += IsPath(value) ? 1 : 0;
  if (count != 0 && count != values.size()) {
    throw py::type_error(what + ": either all are paths or none is");
  }
  return count > 0;
}

std::vector<std::string> Paths(const py::list& values) {
  std::vector<std::string> paths;
  for (const py::handle value : values) {
    paths.push_back(value.cast<std::filesystem::path>().string());
  }
  return paths;
}

void SetScenes(const py::list& scenes, EstimationJob* job) {
  if (ArePaths(scenes, "scene")) {
    job->scene_paths = Paths(scenes);
    return;
  }
  for (const py::handle scene : scenes) job->scenes.push_back(scene.cast<Scene>());
}

void SetTargets(const py::list& targets, EstimationJob* job) {
  if (targets.empty()) return;
  if (ArePaths(targets, "target")) {
    job->target_paths = Paths(targets);
    return;
  }
  if (!job->target.rest_shape.empty() || !job->target.marker_map.empty()) {
    throw py::value_error(
        "rest_shape and marker_map are about targets that are files; set "
        "scene.rest_length, or name the vertices in Observations.add_markers");
  }
  if (!job->scene_paths.empty()) {
    for (const std::string& path : job->scene_paths) {
      job->scenes.push_back(LoadScene(path));
    }
    job->scene_paths.clear();
  }
  if (job->scenes.empty()) {
    throw py::type_error(
        "estimate: a target in memory needs a scene (only meshes in files can do "
        "without)");
  }
  for (size_t i = 0; i < targets.size(); ++i) {
    const Scene& scene = job->scenes[job->scenes.size() == 1 ? 0 : i];
    job->targets.push_back(ObservationsFromPython(targets[i], scene));
    if (i + 1 >= job->scenes.size() && job->scenes.size() > 1) break;
  }
}

// Called after every iteration, by the thread that called estimate.
void Report(const IterationReport& report, const py::object& progress,
            EstimateResult* result, Interrupts* interrupts) {
  result->history.push_back(report);
  const py::gil_scoped_acquire acquire;
  if (progress.is_none()) return;
  try {
    const int wants_to_stop = PyObject_IsTrue(progress(report).ptr());
    if (wants_to_stop < 0) throw py::error_already_set();
    if (wants_to_stop > 0) interrupts->Stop();
  } catch (const py::error_already_set& error) {
    interrupts->Keep(error);
  }
}

// Throws what interrupted the fit, with what there was in its attribute `result`.
void RethrowWith(const ResultPointer& result, Interrupts* interrupts) {
  if (interrupts->exception() == nullptr) return;
  try {
    py::setattr(interrupts->exception()->value(), "result", py::cast(result));
  } catch (const py::error_already_set&) {
    // An exception that takes no attributes goes without.
  }
  interrupts->Rethrow();
}

ResultPointer RunEstimate(const py::list& scenes, const py::list& targets,
                          const py::dict& options, const py::object& progress) {
  auto result = std::make_shared<EstimateResult>();
  SetEstimateOptions(options, &result->job);
  SetScenes(scenes, &result->job);
  SetTargets(targets, &result->job);
  Interrupts interrupts;
  EstimationJob job = result->job;
  job.options.interrupted = [&] { return interrupts.Poll(); };
  job.options.progress = [&](const IterationReport& report) {
    Report(report, progress, result.get(), &interrupts);
  };
  result->input = CallLong(&interrupts, [&] { return LoadEstimationInput(job); });
  Warn(result->input.warnings);
  result->summary = CallWithoutGil(&interrupts, [&] {
    return RunEstimation(job.options, nullptr, &result->input, &result->selection);
  });
  RethrowWith(result, &interrupts);
  return result;
}

}  // namespace

void BindEstimate(py::module_& m) {
  BindEstimateResult(m);
  m.def("_run_estimate", &RunEstimate, py::arg("scenes"), py::arg("targets"),
        py::arg("options"), py::arg("progress"));
}

}  // namespace dpe::python
