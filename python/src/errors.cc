#include "errors.h"

#include <exception>

#include "dpe/engine/scene.h"
#include "module.h"

namespace py = pybind11;

namespace dpe::python {
namespace {

// Alive as long as the module, which is never unloaded.
PyObject* scene_error = nullptr;
PyObject* simulation_error = nullptr;
PyObject* scene_warning = nullptr;

PyObject* NewException(py::module_* m, const char* name, PyObject* base,
                       const char* doc) {
  const std::string full_name = std::string("dpe.") + name;
  PyObject* type = PyErr_NewExceptionWithDoc(full_name.c_str(), doc, base, nullptr);
  if (type == nullptr) throw py::error_already_set();
  m->add_object(name, type);
  return type;
}

}  // namespace

void RaiseSimulationError(const std::string& message, const py::object& trajectory) {
  py::object error = py::handle(simulation_error)(message);
  error.attr("trajectory") = trajectory;
  PyErr_SetObject(simulation_error, error.ptr());
  throw py::error_already_set();
}

void Warn(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) {
    if (PyErr_WarnEx(scene_warning, warning.c_str(), 1) != 0) {
      throw py::error_already_set();
    }
  }
}

void BindErrors(py::module_& m) {
  scene_error = NewException(&m, "SceneError", PyExc_ValueError,
                             "Bad input. The message names the file (or \"scene\"), "
                             "the place in it, the value "
                             "and what is accepted.");
  simulation_error = NewException(
      &m, "SimulationError", PyExc_RuntimeError,
      "A simulation or a derivative pass failed numerically: the message says what "
      "failed, in which object, frame and step. `trajectory` is what was reached "
      "(later "
      "frames are NaN), or None.");
  scene_warning = NewException(
      &m, "SceneWarning", PyExc_UserWarning,
      "Something that is accepted but worth a look: an unknown key, a marker that was "
      "not seen at the beginning.");
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const SceneError& error) {
      PyErr_SetString(scene_error, error.what());
    }
  });
}

}  // namespace dpe::python
