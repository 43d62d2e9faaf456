// Derivatives of a rollout in the shapes that Python sees.
#ifndef DPE_PYTHON_DERIVATIVES_H_
#define DPE_PYTHON_DERIVATIVES_H_

#include <pybind11/pybind11.h>

#include <string>

#include "simulation.h"

namespace dpe::python {

// dL/dp, (parameters,), of dL/dx and dL/dv per frame; see StatesOfObjects.
pybind11::array Gradient(PyRollout* rollout, const pybind11::object& dl_dx,
                         const pybind11::object& dl_dv);

// The tuple (dx, dv): the change of all states for a change dp of the parameters.
pybind11::tuple JacobianVectorProduct(PyRollout* rollout, const pybind11::object& dp);

// dx/dp of one object at some frames and vertices: (frames, vertices, 3, parameters).
// @param frames, vertices  indices, negative ones from the end; None: all
pybind11::array PositionJacobian(PyRollout* rollout, const pybind11::object& frames,
                                 const pybind11::object& vertices, int object,
                                 bool of_velocities, const std::string& method);

}  // namespace dpe::python

#endif  // DPE_PYTHON_DERIVATIVES_H_
