#include "python_cost.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <string>
#include <utility>

#include "arrays.h"
#include "derivative_rows.h"

namespace py = pybind11;

namespace dpe::python {
namespace {

// A copy: the function may keep it, and the evaluator's memory is used again.
py::array Copy(const Eigen::MatrixXd& states, int frame) {
  return py::array(py::dtype::of<double>(), {states.rows() / 3, Eigen::Index{3}},
                   states.col(frame).data());
}

std::vector<StateView> Views(
    const Trajectory& trajectory,
    const std::vector<TrajectoryCost::StateReference>& states) {
  std::vector<StateView> views;
  for (const auto& [object, frame] : states) {
    views.push_back({object, frame, Copy(trajectory.positions[object], frame),
                     Copy(trajectory.velocities[object], frame)});
  }
  return views;
}

py::object Entry(const py::object& list, size_t index, size_t size,
                 const std::string& what) {
  if (list.is_none()) return py::none();
  if (!py::isinstance<py::list>(list) && !py::isinstance<py::tuple>(list)) {
    throw py::value_error(what + " has to be a list with an entry for each state");
  }
  if (py::len(list) != size) {
    throw py::value_error(what + " has " + std::to_string(py::len(list)) +
                          " entries; expected one for each of " + std::to_string(size) +
                          " states");
  }
  return list[py::int_(index)];
}

}  // namespace

bool PythonCost::Evaluate(const Trajectory& trajectory, double* residuals,
                          std::vector<StateDerivative>* derivatives) const {
  const py::gil_scoped_acquire acquire;
  try {
    return Call(trajectory, residuals, derivatives);
  } catch (const py::error_already_set& error) {
    error_ = std::make_unique<py::error_already_set>(error);
  } catch (const py::builtin_exception& error) {
    error.set_error();
    error_ = std::make_unique<py::error_already_set>();
  }
  return false;
}

bool PythonCost::Call(const Trajectory& trajectory, double* residuals,
                      std::vector<StateDerivative>* derivatives) const {
  const bool wanted = derivatives != nullptr;
  const py::object answer = function_(Views(trajectory, states()), wanted);
  if (answer.is_none()) return false;
  py::object values = answer, dx = py::none(), dv = py::none();
  if (wanted) {
    if (!py::isinstance<py::tuple>(answer) || py::len(answer) < 2 ||
        py::len(answer) > 3) {
      throw py::value_error(
          "a residual whose derivatives are wanted has to return (r, dr_dx) or (r, "
          "dr_dx, dr_dv)");
    }
    const auto parts = py::reinterpret_borrow<py::tuple>(answer);
    values = parts[0];
    dx = parts[1];
    if (parts.size() == 3) dv = parts[2];
  }
  const Eigen::VectorXd r = VectorFromArray(values, "residuals", num_residuals());
  std::copy_n(r.data(), r.size(), residuals);
  if (!r.allFinite()) return false;
  for (size_t s = 0; wanted && s < states().size(); ++s) {
    const Eigen::Index n = trajectory.positions[states()[s].object].rows();
    const py::object d_position = Entry(dx, s, states().size(), "dr_dx");
    const py::object d_velocity = Entry(dv, s, states().size(), "dr_dv");
    if (d_position.is_none() && d_velocity.is_none()) continue;
    StateDerivative derivative;
    derivative.frame = states()[s].frame;
    derivative.object = states()[s].object;
    derivative.d_position =
        d_position.is_none() ? SparseRows(num_residuals(), n)
                             : DerivativeRows(d_position, "dr_dx", num_residuals(), n);
    if (!d_velocity.is_none()) {
      derivative.d_velocity = DerivativeRows(d_velocity, "dr_dv", num_residuals(), n);
    }
    derivatives->push_back(std::move(derivative));
  }
  return true;
}

void PythonCost::RethrowError() const {
  if (error_ == nullptr) return;
  const std::unique_ptr<py::error_already_set> error = std::move(error_);
  throw py::error_already_set(*error);
}

void RethrowErrors(const std::vector<CostPointer>& costs) {
  for (const CostPointer& cost : costs) {
    if (const auto* mine = dynamic_cast<const PythonCost*>(cost.get())) {
      mine->RethrowError();
    }
  }
}

}  // namespace dpe::python
