// What makes up the extension module dpe._core: one function per file, called in this
// order by module.cc (a class has to be known before a signature names it).
#ifndef DPE_PYTHON_MODULE_H_
#define DPE_PYTHON_MODULE_H_

#include <pybind11/pybind11.h>

namespace dpe::python {

void BindErrors(pybind11::module_& m);
void BindParameterBlocks(pybind11::module_& m);
void BindColliders(pybind11::module_& m);
void BindScene(pybind11::module_& m);
void BindTrajectory(pybind11::module_& m);
void BindSimulator(pybind11::module_& m);
void BindObservations(pybind11::module_& m);
void BindInverseDynamics(pybind11::module_& m);
void BindUncertainty(pybind11::module_& m);
void BindEstimate(pybind11::module_& m);
void BindCosts(pybind11::module_& m);
void BindResidualProblem(pybind11::module_& m);

}  // namespace dpe::python

#endif  // DPE_PYTHON_MODULE_H_
