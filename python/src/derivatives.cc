#include "derivatives.h"

#include <pybind11/stl.h>

#include <numeric>
#include <utility>
#include <vector>

#include "arrays.h"

namespace py = pybind11;

namespace dpe::python {
namespace {

JacobianMethod MethodFromName(const std::string& name) {
  if (name == "auto") return JacobianMethod::kAuto;
  if (name == "tangent") return JacobianMethod::kTangent;
  if (name == "adjoint") return JacobianMethod::kAdjoint;
  throw py::value_error("method: \"" + name +
                        "\" is not accepted; expected auto, tangent or adjoint");
}

std::vector<int> Indices(const py::object& value, const std::string& what, int size) {
  std::vector<int> indices(size);
  std::iota(indices.begin(), indices.end(), 0);
  if (value.is_none()) return indices;
  indices = value.cast<std::vector<int>>();
  for (int& index : indices) {
    if (index < -size || index >= size) {
      throw py::index_error(what + ": " + std::to_string(index) + "; there are " +
                            std::to_string(size));
    }
    if (index < 0) index += size;
  }
  return indices;
}

// Row 3 i + c reads coordinate c of vertices[i].
SparseRows Selection(const std::vector<int>& vertices, Eigen::Index num_coordinates) {
  SparseRows rows(3 * static_cast<Eigen::Index>(vertices.size()), num_coordinates);
  std::vector<Eigen::Triplet<double>> ones;
  for (size_t i = 0; i < vertices.size(); ++i) {
    for (int c = 0; c < 3; ++c) ones.emplace_back(3 * i + c, 3 * vertices[i] + c, 1.0);
  }
  rows.setFromTriplets(ones.begin(), ones.end());
  return rows;
}

}  // namespace

py::array Gradient(PyRollout* rollout, const py::object& dl_dx,
                   const py::object& dl_dv) {
  const PyTrajectory trajectory = rollout->trajectory();
  std::vector<Eigen::MatrixXd> dx = StatesOfObjects(dl_dx, "dl_dx", trajectory);
  const std::vector<Eigen::MatrixXd> dv = StatesOfObjects(dl_dv, "dl_dv", trajectory);
  if (dx.empty()) dx.resize(trajectory.data->positions.size());
  return ToArray(rollout->Differentiate(
      [&](Sensitivity* sensitivity) { return sensitivity->Gradient(dx, dv); }));
}

py::tuple JacobianVectorProduct(PyRollout* rollout, const py::object& dp) {
  const Eigen::VectorXd direction =
      VectorFromArray(dp, "dp", rollout->simulation().layout().size());
  std::vector<Eigen::MatrixXd> dx, dv;
  rollout->Differentiate([&](Sensitivity* sensitivity) {
    sensitivity->JacobianVectorProduct(direction, &dx, &dv);
    return true;
  });
  return py::make_tuple(StatesToPython(std::move(dx)), StatesToPython(std::move(dv)));
}

py::array PositionJacobian(PyRollout* rollout, const py::object& frames,
                           const py::object& vertices, int object, bool of_velocities,
                           const std::string& method_name) {
  const PyTrajectory trajectory = rollout->trajectory();
  if (object < 0) object = trajectory.OnlyObject();
  const auto& positions = trajectory.data->positions;
  if (object >= static_cast<int>(positions.size()) || positions[object].size() == 0) {
    throw py::index_error("object: " + std::to_string(object) + " was not simulated");
  }
  const Eigen::MatrixXd& x = positions[object];
  const std::vector<int> at = Indices(frames, "frames", static_cast<int>(x.cols()));
  const std::vector<int> which =
      Indices(vertices, "vertices", static_cast<int>(x.rows() / 3));
  const SparseRows selection = Selection(which, x.rows());
  const int rows_per_frame = static_cast<int>(selection.rows());
  std::vector<StateDerivative> derivatives;
  for (size_t i = 0; i < at.size(); ++i) {
    StateDerivative derivative;
    derivative.frame = at[i];
    derivative.object = object;
    derivative.first_row = static_cast<int>(i) * rows_per_frame;
    derivative.d_position =
        of_velocities ? SparseRows(rows_per_frame, x.rows()) : selection;
    if (of_velocities) derivative.d_velocity = selection;
    derivatives.push_back(std::move(derivative));
  }
  const JacobianMethod method = MethodFromName(method_name);
  const int num_rows = static_cast<int>(at.size()) * rows_per_frame;
  const auto jacobian = std::make_shared<RowMajorMatrix>(
      rollout->Differentiate([&](Sensitivity* sensitivity) {
        return sensitivity->Jacobian(derivatives, num_rows, method);
      }));
  return ViewOf(jacobian->data(),
                {static_cast<py::ssize_t>(at.size()),
                 static_cast<py::ssize_t>(which.size()), 3, jacobian->cols()},
                jacobian, /*is_writable=*/true);
}

}  // namespace dpe::python
