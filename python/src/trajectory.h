// A trajectory that Python holds, and the states of its objects as arrays.
#ifndef DPE_PYTHON_TRAJECTORY_H_
#define DPE_PYTHON_TRAJECTORY_H_

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "dpe/engine/scene.h"
#include "dpe/engine/trajectory.h"

namespace dpe::python {

struct PyTrajectory {
  std::shared_ptr<const Trajectory> data;
  std::shared_ptr<const Scene> scene;  // what was simulated

  // The only object that was simulated. @throws AttributeError if there are several
  int OnlyObject() const;
};

// Of one object: arrays that share the trajectory's memory.
struct Motion {
  PyTrajectory trajectory;
  int object = 0;

  pybind11::array positions() const;
  pybind11::array velocities() const;
};

// States, or derivatives with respect to states, of every object, as Python gives them:
// an array (frames, vertices, 3) if only one object was simulated, else a sequence with
// an array or None for each. None: an empty vector.
// @throws ValueError naming `what` if the shapes are not those of the trajectory
std::vector<Eigen::MatrixXd> StatesOfObjects(const pybind11::object& value,
                                             const std::string& what,
                                             const PyTrajectory& trajectory);

// The other way: an array, or a list with an array or None for each object.
pybind11::object StatesToPython(std::vector<Eigen::MatrixXd> states);

}  // namespace dpe::python

#endif  // DPE_PYTHON_TRAJECTORY_H_
