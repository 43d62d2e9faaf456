#include "arrays.h"

#include <utility>

namespace py = pybind11;

namespace dpe::python {
namespace {

Doubles AsDoubles(const py::handle& object, const std::string& what) {
  Doubles array = Doubles::ensure(object);
  if (!array) {
    PyErr_Clear();
    throw py::value_error(what + " is not an array of numbers");
  }
  return array;
}

}  // namespace

std::string ShapeText(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t i = 0; i < array.ndim(); ++i) {
    text += (i > 0 ? ", " : "") + std::to_string(array.shape(i));
  }
  return text + (array.ndim() == 1 ? ",)" : ")");
}

void RefuseShape(const std::string& what, const py::array& array,
                 const std::string& expected) {
  throw py::value_error(what + " has shape " + ShapeText(array) + "; expected " +
                        expected);
}

py::array ToArray(Eigen::VectorXd vector) {
  const auto owner = std::make_shared<Eigen::VectorXd>(std::move(vector));
  return ViewOf(owner->data(), {owner->size()}, owner, /*is_writable=*/true);
}

py::array ToArray(Eigen::MatrixXd matrix) {
  const auto owner = std::make_shared<Eigen::MatrixXd>(std::move(matrix));
  return ViewOf(owner->data(), {owner->cols(), owner->rows()}, owner, true)
      .attr("T")
      .cast<py::array>();
}

py::array StatesView(const Eigen::MatrixXd& states, std::shared_ptr<const void> owner) {
  return ViewOf(states.data(), {states.cols(), states.rows() / 3, 3}, std::move(owner),
                /*is_writable=*/false);
}

py::array StatesToArray(Eigen::MatrixXd states) {
  const auto owner = std::make_shared<Eigen::MatrixXd>(std::move(states));
  return ViewOf(owner->data(), {owner->cols(), owner->rows() / 3, 3}, owner, true);
}

Eigen::MatrixXd StatesFromArray(const py::handle& object, const std::string& what,
                                int num_vertices, int num_frames) {
  const Doubles array = AsDoubles(object, what);
  const auto wanted = [](int size, const char* name) {
    return size < 0 ? std::string(name) : std::to_string(size);
  };
  if (array.ndim() != 3 || array.shape(2) != 3 ||
      (num_frames >= 0 && array.shape(0) != num_frames) ||
      (num_vertices >= 0 && array.shape(1) != num_vertices)) {
    RefuseShape(what, array,
                "(" + wanted(num_frames, "frames") + ", " +
                    wanted(num_vertices, "vertices") + ", 3)");
  }
  return Eigen::Map<const Eigen::MatrixXd>(array.data(), 3 * array.shape(1),
                                           array.shape(0));
}

Eigen::VectorXd VectorFromArray(const py::handle& object, const std::string& what,
                                Eigen::Index size) {
  const Doubles array = AsDoubles(object, what);
  if (array.ndim() != 1 || (size >= 0 && array.shape(0) != size)) {
    RefuseShape(what, array,
                size < 0 ? "one dimension" : "(" + std::to_string(size) + ",)");
  }
  return Eigen::Map<const Eigen::VectorXd>(array.data(), array.shape(0));
}

}  // namespace dpe::python
