// The options of an estimation by their names in Python, which are those of
// estimate_cloth's flags.
#ifndef DPE_PYTHON_ESTIMATE_OPTIONS_H_
#define DPE_PYTHON_ESTIMATE_OPTIONS_H_

#include <pybind11/pybind11.h>

#include <string>

#include "dpe/estimation/estimation_job.h"

namespace dpe::python {

// Sets what the dictionary names.
// @throws TypeError for a name that is not an option or a value of another type,
//         ValueError and SceneError for values that are not accepted; all name the
//         option
void SetEstimateOptions(const pybind11::dict& options, EstimationJob* job);

}  // namespace dpe::python

#endif  // DPE_PYTHON_ESTIMATE_OPTIONS_H_
