#include "derivative_rows.h"

#include <vector>

#include "arrays.h"

namespace py = pybind11;

namespace dpe::python {
namespace {

SparseRows FromSparse(const py::object& value, const std::string& what, int num_rows,
                      Eigen::Index num_coordinates) {
  const py::object csr = value.attr("tocsr")();
  const auto shape = csr.attr("shape").cast<py::tuple>();
  if (shape[0].cast<int>() != num_rows || shape[1].cast<int>() != num_coordinates) {
    throw py::value_error(what + " has shape " +
                          std::string(py::str(py::handle(shape))) + "; expected (" +
                          std::to_string(num_rows) + ", " +
                          std::to_string(num_coordinates) + ")");
  }
  const auto values = csr.attr("data").cast<Doubles>();
  const auto columns = csr.attr("indices").cast<Ints>();
  const auto starts = csr.attr("indptr").cast<Ints>();
  std::vector<Eigen::Triplet<double>> entries;
  for (int row = 0; row < num_rows; ++row) {
    for (int i = *starts.data(row); i < *starts.data(row + 1); ++i) {
      entries.emplace_back(row, *columns.data(i), *values.data(i));
    }
  }
  SparseRows rows(num_rows, num_coordinates);
  rows.setFromTriplets(entries.begin(), entries.end());
  return rows;
}

}  // namespace

SparseRows DerivativeRows(const py::object& value, const std::string& what,
                          int num_rows, Eigen::Index num_coordinates) {
  if (py::hasattr(value, "tocsr")) {
    return FromSparse(value, what, num_rows, num_coordinates);
  }
  const Doubles array = Doubles::ensure(value);
  if (!array) {
    PyErr_Clear();
    throw py::value_error(what + " is not an array of numbers");
  }
  const bool is_flat = array.ndim() == 2 && array.shape(1) == num_coordinates;
  const bool is_deep =
      array.ndim() == 3 && array.shape(2) == 3 && 3 * array.shape(1) == num_coordinates;
  if (!(is_flat || is_deep) || array.shape(0) != num_rows) {
    RefuseShape(what, array,
                "(" + std::to_string(num_rows) + ", " +
                    std::to_string(num_coordinates / 3) + ", 3)");
  }
  return Eigen::Map<const RowMajorMatrix>(array.data(), num_rows, num_coordinates)
      .sparseView();
}

}  // namespace dpe::python
