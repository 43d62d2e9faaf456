// dpe.Scene and dpe.Cloth.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "arrays.h"
#include "cloth.h"
#include "cloth_properties.h"
#include "dpe/engine/parameters.h"
#include "dpe/engine/scene_io.h"
#include "errors.h"
#include "module.h"
#include "scene_builders.h"

namespace py = pybind11;

namespace dpe::python {
namespace {

using ScenePointer = std::shared_ptr<Scene>;
using ClothClass = py::class_<Cloth>;

ScenePointer Load(const std::filesystem::path& path) {
  std::vector<std::string> warnings;
  auto scene = std::make_shared<Scene>(LoadScene(path.string(), &warnings));
  Warn(warnings);
  return scene;
}

ScenePointer Parse(const std::string& text, const std::string& name) {
  std::vector<std::string> warnings;
  auto scene = std::make_shared<Scene>(ParseScene(text, name, &warnings));
  Warn(warnings);
  return scene;
}

std::vector<std::string> Validate(const Scene& scene) {
  std::vector<std::string> warnings;
  ValidateScene(scene, "scene", &warnings);
  return warnings;
}

std::vector<Cloth> Objects(const ScenePointer& scene) {
  std::vector<Cloth> cloths;
  for (size_t i = 0; i < scene->objects.size(); ++i) {
    cloths.push_back({scene, static_cast<int>(i)});
  }
  return cloths;
}

ScenePointer WithParameters(const Scene& scene, const py::object& parameters) {
  const ParameterLayout layout(scene);
  auto changed = std::make_shared<Scene>(scene);
  layout.Insert(VectorFromArray(parameters, "parameters", layout.size()),
                changed.get());
  return changed;
}

void SetVector(const py::object& value, const std::string& what,
               Eigen::Vector3d* vector) {
  *vector = VectorFromArray(value, what, 3);
}

std::string ModesOf(const ClothObject& cloth) {
  return {ParameterModeLetter(cloth.mass_mode),
          ParameterModeLetter(cloth.stiffness_mode)};
}

std::string Repr(const Scene& scene) {
  std::ostringstream text;
  text << "<dpe.Scene";
  if (!scene.title.empty()) text << " \"" << scene.title << '"';
  for (const ClothObject& cloth : scene.objects) {
    text << ", cloth of " << cloth.num_vertices() << " vertices and "
         << cloth.num_springs() << " springs (" << ModesOf(cloth) << ")";
  }
  text << ", " << scene.num_frames << " frames of " << scene.delta << " s>";
  return text.str();
}

void BindFiles(SceneClass* type) {
  type->def_static("load", &Load, py::arg("path"),
                   "Reads a scene file. What is worth a look becomes a SceneWarning. "
                   "Raises SceneError naming file, place, value and what is accepted.")
      .def_static("parse", &Parse, py::arg("text"), py::arg("name") = "scene",
                  "As load, from text; `name` stands for the file in messages.")
      .def("to_json", &SceneToJson,
           "The scene as text that parse reads back to the same numbers, bit by bit.")
      .def(
          "save",
          [](const Scene& scene, const std::filesystem::path& path) {
            SaveScene(scene, path.string());
          },
          py::arg("path"), "Writes to_json() to a file, whole or not at all.")
      .def("validate", &Validate,
           "Checks a scene that was changed, as load does. Returns warnings. Raises "
           "SceneError.")
      .def(
          "copy", [](const Scene& scene) { return std::make_shared<Scene>(scene); },
          "A scene with memory of its own.")
      .def("__copy__",
           [](const Scene& scene) { return std::make_shared<Scene>(scene); })
      .def(
          "__deepcopy__",
          [](const Scene& scene, const py::dict&) {
            return std::make_shared<Scene>(scene);
          },
          py::arg("memo"))
      .def(py::pickle([](const Scene& scene) { return SceneToJson(scene); },
                      [](const std::string& text) {
                        return std::make_shared<Scene>(ParseScene(text, "pickle"));
                      }))
      .def("__repr__", &Repr);
}

void BindTime(SceneClass* type) {
  type->def_readwrite("title", &Scene::title, "What the scene is called.")
      .def_readwrite("delta", &Scene::delta, "Length of a frame, s.")
      .def_readwrite("frames", &Scene::num_frames,
                     "Frames to simulate and to fit, the initial state included.")
      .def_readwrite("steps_per_frame", &Scene::steps_per_frame,
                     "Integration steps in a frame.")
      .def_property(
          "integration_method",
          [](const Scene& s) { return IntegrationMethodName(s.integration_method); },
          [](Scene& s, const py::object& name) {
            s.integration_method = IntegrationMethodFromName(py::str(name));
          },
          "\"explicit_euler\", \"symplectic_euler\", \"linearly_implicit_euler\", "
          "\"implicit_euler\" or \"tr_bdf2\"; a number from 0 to 4 may be assigned.")
      .def_readwrite("tolerance", &Scene::tolerance,
                     "Relative residual, where an iterative solver is used.")
      .def_readwrite("solver", &Scene::solver,
                     "How steps are solved: \"cholesky\", \"cg\" or \"auto\".");
}

void BindSurroundings(SceneClass* type) {
  type->def_property(
          "wind",
          [](const ScenePointer& s) { return ViewOf(s->wind.data(), {3}, s, true); },
          [](Scene& s, const py::object& value) { SetVector(value, "wind", &s.wind); },
          "m/s, shape (3,), y up. A view.")
      .def_property(
          "gravity",
          [](const ScenePointer& s) { return ViewOf(s->gravity.data(), {3}, s, true); },
          [](Scene& s, const py::object& value) {
            SetVector(value, "gravity", &s.gravity);
          },
          "m/s^2, shape (3,), y up. A view.")
      .def_property(
          "aerodynamics",
          [](const Scene& s) { return AerodynamicsLawName(s.aerodynamics); },
          [](Scene& s, const std::string& name) {
            if (name == AerodynamicsLawName(AerodynamicsLaw::kAuthored)) {
              s.aerodynamics = AerodynamicsLaw::kAuthored;
            } else if (name == AerodynamicsLawName(AerodynamicsLaw::kUnitNormal)) {
              s.aerodynamics = AerodynamicsLaw::kUnitNormal;
            } else {
              throw SceneError("aerodynamics: \"" + name +
                               "\" is not accepted; expected authored or unit_normal");
            }
          },
          "The drag law: \"authored\" or \"unit_normal\".")
      .def_readwrite("colliders", &Scene::colliders,
                     "Planes and spheres. Reading gives a list of copies; assign to "
                     "change them.");
}

void BindUnknowns(SceneClass* type) {
  type->def_property(
          "settings", &SettingsString,
          [](Scene& s, const std::string& settings) { ApplySettings(settings, &s); },
          "What is unknown: two letters per object, mass then stiffness, separated by "
          "commas. n: known, G: one value, L: one per vertex or spring, R: one per "
          "group.")
      .def_readwrite("estimate_wind", &Scene::estimate_wind,
                     "Whether the wind is unknown.")
      .def_property_readonly(
          "parameter_blocks",
          [](const Scene& s) { return ParameterLayout(s).blocks(); },
          "The unknowns in the order of the parameter vector.")
      .def_property_readonly(
          "parameters",
          [](const Scene& s) { return ToArray(ParameterLayout(s).Extract(s)); },
          "The parameter vector p that describes the scene best, SI units, shape "
          "(parameters,). A copy.")
      .def("with_parameters", &WithParameters, py::arg("parameters"),
           "A copy of the scene with these values (SI units) of its unknowns.");
}

}  // namespace

void BindScene(py::module_& m) {
  ClothClass cloth(m, "Cloth",
                   "A cloth of a scene: vertices, springs and triangles. Changing it "
                   "changes the scene. SI units.");
  ClothProperties<Cloth, ClothClass>(&cloth).BindAll();
  cloth.def_property_readonly(
      "settings", [](const Cloth& c) { return ModesOf(c.object()); },
      "Two letters, mass then stiffness; set them by scene.settings.");
  SceneClass scene(m, "Scene",
                   "Cloths, their surroundings, and which of their parameters are "
                   "unknown. SI units, "
                   "y up. The attributes of a cloth are those of the scene too, if it "
                   "has only one.");
  BindFiles(&scene);
  BindSceneBuilders(&scene);
  BindTime(&scene);
  BindSurroundings(&scene);
  BindUnknowns(&scene);
  ClothProperties<ScenePointer, SceneClass>(&scene).BindAll();
  scene.def_property_readonly("objects", &Objects, "Its cloths, a list of Cloth.")
      .def(
          "add",
          [](Scene& s, const Cloth& other) { s.objects.push_back(other.object()); },
          py::arg("cloth"), "Appends a copy of another scene's cloth.");
}

}  // namespace dpe::python
