#include "module.h"

PYBIND11_MODULE(_core, m) {
  m.doc() = "Differentiable cloth: the C++ part of dpe. Import dpe instead.";
  dpe::python::BindErrors(m);
  dpe::python::BindParameterBlocks(m);
  dpe::python::BindColliders(m);
  dpe::python::BindScene(m);
  dpe::python::BindTrajectory(m);
  dpe::python::BindSimulator(m);
  dpe::python::BindObservations(m);
  dpe::python::BindInverseDynamics(m);
  dpe::python::BindUncertainty(m);
  dpe::python::BindEstimate(m);
  dpe::python::BindCosts(m);
  dpe::python::BindResidualProblem(m);
}
