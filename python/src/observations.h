// Observations from Python: arrays, files, or what a trajectory shows.
#ifndef DPE_PYTHON_OBSERVATIONS_H_
#define DPE_PYTHON_OBSERVATIONS_H_

#include <pybind11/pybind11.h>

#include "dpe/engine/scene.h"
#include "dpe/estimation/observations.h"

namespace dpe::python {

// @param value  Observations, a Trajectory, an array (frames, vertices, 3) if the scene
//               has one object, or a sequence with an array or None for each; NaN: not
//               observed
// @throws ValueError
Observations ObservationsFromPython(const pybind11::object& value, const Scene& scene);

}  // namespace dpe::python

#endif  // DPE_PYTHON_OBSERVATIONS_H_
