// Between NumPy arrays and Eigen.
//
// A trajectory's positions are a 3N x F matrix in column-major order: frame after
// frame, vertex after vertex, x y z. That is, byte for byte, a NumPy array of shape (F,
// N, 3) in C order, so it is handed out as it is, with something that keeps it alive.
#ifndef DPE_PYTHON_ARRAYS_H_
#define DPE_PYTHON_ARRAYS_H_

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

namespace dpe::python {

using Doubles =
    pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;
using Ints =
    pybind11::array_t<int, pybind11::array::c_style | pybind11::array::forcecast>;

// An array of T in C order over memory that belongs to `owner`; no copy is made.
template <class T>
pybind11::array ViewOf(const T* data, std::vector<pybind11::ssize_t> shape,
                       std::shared_ptr<const void> owner, bool is_writable) {
  const pybind11::capsule base(
      new std::shared_ptr<const void>(std::move(owner)),
      [](void* pointer) { delete static_cast<std::shared_ptr<const void>*>(pointer); });
  pybind11::array view(pybind11::dtype::of<T>(), std::move(shape), data, base);
  if (!is_writable) view.attr("flags").attr("writeable") = false;
  return view;
}

// Takes over what it is given; no copy of the numbers is made.
pybind11::array ToArray(Eigen::VectorXd vector);

// A matrix as (rows, columns), in whatever order it has.
pybind11::array ToArray(Eigen::MatrixXd matrix);

// 3N x F to (F, N, 3). The first shares memory with `owner` and is read-only.
pybind11::array StatesView(const Eigen::MatrixXd& states,
                           std::shared_ptr<const void> owner);
pybind11::array StatesToArray(Eigen::MatrixXd states);

// (F, N, 3) to 3N x F. @throws ValueError naming `what` and the shapes.
// @param num_vertices, num_frames  as they have to be; negative: any
Eigen::MatrixXd StatesFromArray(const pybind11::handle& object, const std::string& what,
                                int num_vertices, int num_frames);

// A vector of this many numbers. @param size  negative: any
Eigen::VectorXd VectorFromArray(const pybind11::handle& object, const std::string& what,
                                Eigen::Index size);

// "(3, 4)"
std::string ShapeText(const pybind11::array& array);

// Raises ValueError("WHAT has shape A; expected B").
[[noreturn]] void RefuseShape(const std::string& what, const pybind11::array& array,
                              const std::string& expected);

}  // namespace dpe::python

#endif  // DPE_PYTHON_ARRAYS_H_
