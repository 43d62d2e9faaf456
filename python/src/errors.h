// Errors and warnings as Python sees them. SceneError is translated where it is thrown;
// what is said here is how the module raises its own.
#ifndef DPE_PYTHON_ERRORS_H_
#define DPE_PYTHON_ERRORS_H_

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

namespace dpe::python {

// Raises dpe.SimulationError. @param trajectory  what was reached; None: nothing
[[noreturn]] void RaiseSimulationError(const std::string& message,
                                       const pybind11::object& trajectory);

// Hands what a loader found worth a look to Python's `warnings`, as dpe.SceneWarning.
// @throws pybind11::error_already_set where the user has made warnings errors
void Warn(const std::vector<std::string>& warnings);

}  // namespace dpe::python

#endif  // DPE_PYTHON_ERRORS_H_
