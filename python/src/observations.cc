#include "observations.h"

#include <pybind11/stl.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "errors.h"
#include "module.h"
#include "trajectory.h"

namespace py = pybind11;

namespace dpe::python {
namespace {

bool IsList(const py::handle& value) {
  return py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value);
}

// One matrix per object.
std::vector<Eigen::MatrixXd> PositionsFromPython(const py::object& value) {
  std::vector<Eigen::MatrixXd> positions;
  if (value.is_none()) return positions;
  if (!IsList(value)) return {StatesFromArray(value, "positions", -1, -1)};
  for (const py::handle entry : value) {
    positions.push_back(entry.is_none() ? Eigen::MatrixXd()
                                        : StatesFromArray(entry, "positions", -1, -1));
  }
  return positions;
}

// (frames, vertices) of each object, or one number for all.
void SetSigma(const py::object& value, Observations* observations) {
  if (py::isinstance<py::float_>(value) || py::isinstance<py::int_>(value)) {
    observations->sigma = value.cast<double>();
    if (!(observations->sigma >= 0.0)) {
      throw py::value_error("sigma: accepted are 0 (not known) or more (m)");
    }
    return;
  }
  const py::object list = IsList(value) ? value : py::make_tuple(value);
  size_t object = 0;
  for (const py::handle entry : list) {
    if (object >= observations->positions.size()) {
      throw py::value_error("sigma is of more objects than were observed");
    }
    const Eigen::MatrixXd& x = observations->positions[object++];
    observations->sigmas.emplace_back();
    if (entry.is_none()) continue;
    const Doubles array = Doubles::ensure(entry);
    if (!array || array.ndim() != 2 || array.shape(0) != x.cols() ||
        3 * array.shape(1) != x.rows()) {
      PyErr_Clear();
      throw py::value_error(
          "sigma has to be a number or an array of shape (frames, vertices)");
    }
    observations->sigmas.back() =
        Eigen::Map<const Eigen::MatrixXd>(array.data(), array.shape(1), array.shape(0));
  }
}

Marker MakeMarker(int object, const Ints& vertices, const Doubles& weights,
                  py::ssize_t index) {
  Marker marker;
  marker.name = std::to_string(index);
  marker.object = object;
  for (py::ssize_t k = 0; k < vertices.shape(1); ++k) {
    marker.vertices.push_back(*vertices.data(index, k));
    marker.weights.push_back(*weights.data(index, k));
  }
  return marker;
}

void CheckMarkerShapes(const Ints& vertices, const Doubles& weights,
                       const Doubles& times) {
  if (vertices.ndim() != 2 || (vertices.shape(1) != 1 && vertices.shape(1) != 3)) {
    RefuseShape("vertices", vertices, "(markers, 1) or (markers, 3)");
  }
  if (weights.ndim() != 2 || weights.shape(0) != vertices.shape(0) ||
      weights.shape(1) != vertices.shape(1)) {
    RefuseShape("weights", weights, "the shape of vertices " + ShapeText(vertices));
  }
  if (times.ndim() != 1) RefuseShape("times", times, "(samples,)");
}

// Appends markers and, of each, the samples that are not NaN.
void AddMarkers(Observations* observations, const Ints& vertices,
                const Doubles& weights, const Doubles& times, const Doubles& positions,
                double sigma, int object) {
  CheckMarkerShapes(vertices, weights, times);
  if (positions.ndim() != 3 || positions.shape(0) != times.shape(0) ||
      positions.shape(1) != vertices.shape(0) || positions.shape(2) != 3) {
    RefuseShape("positions", positions,
                "(" + std::to_string(times.shape(0)) + ", " +
                    std::to_string(vertices.shape(0)) + ", 3)");
  }
  const int first = static_cast<int>(observations->markers.size());
  for (py::ssize_t m = 0; m < vertices.shape(0); ++m) {
    observations->markers.push_back(MakeMarker(object, vertices, weights, m));
  }
  for (py::ssize_t t = 0; t < times.shape(0); ++t) {
    if (!(*times.data(t) >= 0.0))
      throw py::value_error("times: accepted are 0 or more");
    for (py::ssize_t m = 0; m < vertices.shape(0); ++m) {
      MarkerSample sample;
      sample.marker = first + static_cast<int>(m);
      sample.time = *times.data(t);
      sample.position = Eigen::Map<const Eigen::Vector3d>(positions.data(t, m, 0));
      sample.sigma = sigma;
      if (!sample.position.hasNaN()) observations->samples.push_back(sample);
    }
  }
}

// @param num_vertices  of each object
void CheckMarkers(const std::vector<Marker>& markers,
                  const std::vector<int>& num_vertices) {
  for (const Marker& marker : markers) {
    const bool is_known =
        marker.object >= 0 && marker.object < static_cast<int>(num_vertices.size());
    if (!is_known) {
      throw py::value_error("marker " + marker.name + " is of object " +
                            std::to_string(marker.object) + "; there are " +
                            std::to_string(num_vertices.size()));
    }
    double sum = 0.0;
    for (size_t k = 0; k < marker.vertices.size(); ++k) {
      sum += marker.weights[k];
      if (marker.vertices[k] < 0 || marker.vertices[k] >= num_vertices[marker.object]) {
        throw py::value_error("marker " + marker.name + " is on vertex " +
                              std::to_string(marker.vertices[k]) + "; there are " +
                              std::to_string(num_vertices[marker.object]));
      }
    }
    if (!(std::abs(sum - 1.0) < 1e-6)) {
      throw py::value_error("the weights of marker " + marker.name + " add up to " +
                            std::to_string(sum) + "; expected 1");
    }
  }
}

py::array MarkerPositions(const PyTrajectory& trajectory, const Ints& vertices,
                          const Doubles& weights, const Doubles& times, int object) {
  if (object < 0) object = trajectory.OnlyObject();
  CheckMarkerShapes(vertices, weights, times);
  const Trajectory& data = *trajectory.data;
  std::vector<int> num_vertices;
  for (const Eigen::MatrixXd& x : data.positions) {
    num_vertices.push_back(static_cast<int>(x.rows() / 3));
  }
  std::vector<Marker> markers;
  for (py::ssize_t m = 0; m < vertices.shape(0); ++m) {
    markers.push_back(MakeMarker(object, vertices, weights, m));
  }
  CheckMarkers(markers, num_vertices);
  Eigen::MatrixXd places(3 * vertices.shape(0), times.shape(0));
  for (py::ssize_t t = 0; t < times.shape(0); ++t) {
    const double time = *times.data(t);
    if (!(time >= 0.0 && time <= data.num_frames() - 1)) {
      throw py::value_error("times: accepted are 0 to " +
                            std::to_string(data.num_frames() - 1) + " (in frames)");
    }
    for (size_t m = 0; m < markers.size(); ++m) {
      places.block<3, 1>(3 * m, t) =
          MarkerPosition(data, markers[m], time, data.num_frames());
    }
  }
  return StatesToArray(std::move(places));
}

std::string Repr(const Observations& observations) {
  long count = 0;
  for (size_t i = 0; i < observations.positions.size(); ++i) {
    count += observations.NumObserved(static_cast<int>(i));
  }
  return "<dpe.Observations of " + std::to_string(observations.num_frames()) +
         " frames: " + std::to_string(count) + " positions of vertices, " +
         std::to_string(observations.samples.size()) + " of markers>";
}

}  // namespace

Observations ObservationsFromPython(const py::object& value, const Scene& scene) {
  Observations observations;
  if (py::isinstance<Observations>(value)) {
    observations = value.cast<Observations>();
  } else if (py::isinstance<PyTrajectory>(value)) {
    observations = ObserveAll(*value.cast<PyTrajectory>().data);
  } else {
    observations.positions = PositionsFromPython(value);
  }
  const size_t count = scene.objects.size();
  if (observations.positions.size() > count) {
    throw py::value_error("positions are of " +
                          std::to_string(observations.positions.size()) +
                          " objects; the scene has " + std::to_string(count));
  }
  observations.positions.resize(count);
  for (size_t i = 0; i < count; ++i) {
    const Eigen::Index rows = observations.positions[i].rows();
    if (rows == 0 || rows == 3 * scene.objects[i].num_vertices()) continue;
    throw py::value_error("positions are of " + std::to_string(rows / 3) +
                          " vertices; object " + std::to_string(i) +
                          " of the scene has " +
                          std::to_string(scene.objects[i].num_vertices()));
  }
  std::vector<int> num_vertices;
  for (const ClothObject& cloth : scene.objects) {
    num_vertices.push_back(cloth.num_vertices());
  }
  CheckMarkers(observations.markers, num_vertices);
  return observations;
}

void BindObservations(py::module_& m) {
  py::class_<Observations>(
      m, "Observations",
      "What was seen of a cloth. positions: m, shape (frames, vertices, 3), NaN where "
      "a "
      "vertex was not seen; of several objects a list with an array or None for each. "
      "sigma: standard deviation of the noise on a coordinate, m: one number (0: not "
      "known), or (frames, vertices).")
      .def(py::init([](const py::object& positions, const py::object& sigma) {
             Observations observations;
             if (py::isinstance<PyTrajectory>(positions)) {
               observations = ObserveAll(*positions.cast<PyTrajectory>().data);
             } else {
               observations.positions = PositionsFromPython(positions);
             }
             SetSigma(sigma, &observations);
             return observations;
           }),
           py::arg("positions") = py::none(), py::arg("sigma") = 0.0)
      .def(
          "add_markers", &AddMarkers, py::arg("vertices"), py::arg("weights"),
          py::arg("times"), py::arg("positions"), py::kw_only(), py::arg("sigma") = 0.0,
          py::arg("object") = 0,
          "Adds points of the cloth that were seen. vertices: (markers, 1) or "
          "(markers, "
          "3), the corners of a triangle; weights: likewise, barycentric, sum 1; "
          "times: "
          "in frames since frame 0, need not be whole, shape (samples,); positions: m, "
          "(samples, markers, 3), NaN where a marker was not seen. sigma: m; 0: that "
          "of "
          "the observations.")
      .def_property_readonly(
          "positions",
          [](const Observations& o) -> py::object {
            return StatesToPython(o.positions);
          },
          "m, (frames, vertices, 3), or a list of those. A copy.")
      .def_property_readonly("frames", &Observations::num_frames,
                             "How many frames they reach into, frame 0 included.")
      .def_property_readonly(
          "num_markers", [](const Observations& o) { return o.markers.size(); },
          "How many markers there are.")
      .def_property_readonly(
          "num_samples", [](const Observations& o) { return o.samples.size(); },
          "How many positions of markers there are.")
      .def_readonly("sigma", &Observations::sigma,
                    "m, of every coordinate for which nothing else is given; 0: not "
                    "known.")
      .def(
          "add_noise",
          [](Observations& o, const Scene& scene, double sigma, std::uint64_t seed) {
            AddNoise(scene, sigma, seed, &o);
          },
          py::arg("scene"), py::arg("sigma"), py::arg("seed") = 0,
          "Adds normal noise of this standard deviation (m) to every coordinate of "
          "free "
          "vertices and of markers after frame 0.")
      .def("__repr__", &Repr);
  m.def("marker_positions", &MarkerPositions, py::arg("trajectory"),
        py::arg("vertices"), py::arg("weights"), py::arg("times"), py::kw_only(),
        py::arg("object") = -1,
        "Where simulated markers are, m, shape (samples, markers, 3); arguments as for "
        "Observations.add_markers. Between frames a cubic is drawn through the four "
        "nearest.");
}

}  // namespace dpe::python
