// The derivative of a residual with respect to one state, from Python.
#ifndef DPE_PYTHON_DERIVATIVE_ROWS_H_
#define DPE_PYTHON_DERIVATIVE_ROWS_H_

#include <pybind11/pybind11.h>

#include <string>

#include "dpe/engine/sensitivity.h"

namespace dpe::python {

// @param value  (rows, vertices, 3), (rows, 3 vertices) or a scipy.sparse matrix of the
//               latter shape; zeros of arrays are left out
// @throws ValueError naming `what` and the shapes
SparseRows DerivativeRows(const pybind11::object& value, const std::string& what,
                          int num_rows, Eigen::Index num_coordinates);

}  // namespace dpe::python

#endif  // DPE_PYTHON_DERIVATIVE_ROWS_H_
