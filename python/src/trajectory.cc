#include "trajectory.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "arrays.h"
#include "dpe/estimation/trajectory_io.h"
#include "module.h"

namespace py = pybind11;

namespace dpe::python {
namespace {

std::vector<Motion> Objects(const PyTrajectory& trajectory) {
  std::vector<Motion> motions;
  for (size_t i = 0; i < trajectory.data->positions.size(); ++i) {
    motions.push_back({trajectory, static_cast<int>(i)});
  }
  return motions;
}

py::array Times(const PyTrajectory& trajectory) {
  const int frames = trajectory.data->num_frames();
  Eigen::VectorXd times(frames);
  for (int f = 0; f < frames; ++f) times[f] = f * trajectory.scene->delta;
  return ToArray(std::move(times));
}

std::vector<std::string> Save(const PyTrajectory& trajectory,
                              const std::filesystem::path& path,
                              const std::string& format) {
  const TrajectoryFormat parsed = TrajectoryFormatFromName(format);
  const py::gil_scoped_release release;
  return WriteTrajectory(path.string(), parsed, *trajectory.data, *trajectory.scene);
}

std::string Repr(const PyTrajectory& trajectory) {
  return "<dpe.Trajectory of " + std::to_string(trajectory.data->num_frames()) +
         " frames" +
         (trajectory.data->status.ok() ? ""
                                       : ": " + trajectory.data->status.Message()) +
         ">";
}

void BindMotion(py::module_& m) {
  py::class_<Motion>(m, "Motion", "What one object of a scene did.")
      .def_property_readonly(
          "positions", &Motion::positions,
          "m, shape (frames, vertices, 3), float64, read-only: the engine's own "
          "memory, "
          "which it keeps alive. (0, 0, 3) if the object was not simulated.")
      .def_property_readonly("velocities", &Motion::velocities, "m/s, likewise.");
}

}  // namespace

int PyTrajectory::OnlyObject() const {
  int only = -1, count = 0;
  for (size_t i = 0; i < data->positions.size(); ++i) {
    if (data->positions[i].size() == 0) continue;
    only = static_cast<int>(i);
    ++count;
  }
  if (count == 1) return only;
  throw py::attribute_error(std::to_string(count) +
                            " objects were simulated; each of trajectory.objects has "
                            "this attribute");
}

py::array Motion::positions() const {
  return StatesView(trajectory.data->positions[object], trajectory.data);
}

py::array Motion::velocities() const {
  return StatesView(trajectory.data->velocities[object], trajectory.data);
}

std::vector<Eigen::MatrixXd> StatesOfObjects(const py::object& value,
                                             const std::string& what,
                                             const PyTrajectory& trajectory) {
  if (value.is_none()) return {};
  const std::vector<Eigen::MatrixXd>& like = trajectory.data->positions;
  std::vector<Eigen::MatrixXd> states(like.size());
  const auto convert = [&](const py::handle& array, size_t object) {
    states[object] =
        StatesFromArray(array, what, static_cast<int>(like[object].rows() / 3),
                        static_cast<int>(like[object].cols()));
  };
  const bool is_list =
      py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value);
  if (!is_list) {
    convert(value, trajectory.OnlyObject());
    return states;
  }
  const auto list = py::reinterpret_borrow<py::sequence>(value);
  if (list.size() != like.size()) {
    throw py::value_error(what + " has " + std::to_string(list.size()) +
                          " entries; expected one for each of " +
                          std::to_string(like.size()) + " objects");
  }
  for (size_t i = 0; i < like.size(); ++i) {
    const py::object entry = list[i];
    if (!entry.is_none()) convert(entry, i);
  }
  return states;
}

py::object StatesToPython(std::vector<Eigen::MatrixXd> states) {
  const auto count = std::count_if(states.begin(), states.end(),
                                   [](const auto& m) { return m.size() > 0; });
  py::list list;
  for (Eigen::MatrixXd& m : states) {
    if (m.size() == 0) {
      if (count != 1) list.append(py::none());
    } else if (count == 1) {
      return StatesToArray(std::move(m));
    } else {
      list.append(StatesToArray(std::move(m)));
    }
  }
  return std::move(list);
}

void BindTrajectory(py::module_& m) {
  BindMotion(m);
  py::class_<PyTrajectory>(
      m, "Trajectory",
      "What a simulation passed through, frame by frame; frame 0 is the initial state.")
      .def_property_readonly(
          "positions",
          [](const PyTrajectory& t) {
            return Motion{t, t.OnlyObject()}.positions();
          },
          "m, shape (frames, vertices, 3), float64, read-only, not a copy. Of a scene "
          "with one object; else see objects.")
      .def_property_readonly(
          "velocities",
          [](const PyTrajectory& t) {
            return Motion{t, t.OnlyObject()}.velocities();
          },
          "m/s, shape (frames, vertices, 3), likewise.")
      .def_property_readonly("objects", &Objects, "A Motion for each object.")
      .def_property_readonly("times", &Times, "s since frame 0, shape (frames,).")
      .def_property_readonly(
          "frames", [](const PyTrajectory& t) { return t.data->num_frames(); },
          "How many frames it holds, frame 0 included.")
      .def_property_readonly(
          "ok", [](const PyTrajectory& t) { return t.data->status.ok(); },
          "Whether the last frame was reached. If not, later frames are NaN.")
      .def_property_readonly(
          "message", [](const PyTrajectory& t) { return t.data->status.Message(); },
          "What failed, in which object, frame and step.")
      .def("save", &Save, py::arg("path"), py::arg("format") = "auto",
           "Writes \"csv\", \"obj\" (a path with one *), \"pc2\" or \"npy\"; \"auto\": "
           "by the end of the name. Returns the files written.")
      .def("__len__", [](const PyTrajectory& t) { return t.data->num_frames(); })
      .def("__repr__", &Repr);
}

}  // namespace dpe::python
