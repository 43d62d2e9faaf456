// Writes scene files: the known presets, and cloths of other shapes and materials.
#include <gflags/gflags.h>

#include <iostream>
#include <string>

#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/scene_io.h"
#include "support/flag_values.h"
#include "support/run_main.h"

DEFINE_string(preset, "side",
              "Pins, wind, frames and plane of the cloth: side (one row fixed, lying), "
              "corners (four corners fixed, lying), flag (one row fixed, standing, "
              "strong wind), flag_no_wind.");
DEFINE_string(output, "", "Scene file to write.");

DEFINE_int32(rows, 12, "Rows of vertices of the grid (along z).");
DEFINE_int32(cols, 12, "Columns of vertices of the grid (along x, or y if standing).");
DEFINE_double(size, 7.0, "Length of the edges of the grid, m.");
DEFINE_string(mesh, "",
              "OBJ file to take the cloth's shape from, instead of a grid. Nothing is "
              "pinned then unless --pin_box or --pin_vertices says so.");

DEFINE_double(traction_stiffness, 50.0, "K of springs along edges, N/m.");
DEFINE_double(shear_stiffness, -1.0,
              "K of springs along diagonals, N/m; negative: as traction_stiffness.");
DEFINE_double(bending_stiffness, 12.5, "K of springs across edges, N/m.");
DEFINE_double(density, 0.1, "Mass per area, kg/m^2.");
DEFINE_double(damping, 0.1, "Damping of the cloth, 1/s.");
DEFINE_double(drag, 0.1, "Drag coefficient.");

DEFINE_string(
    pin_box, "",
    "Fix the vertices in boxes x0,y0,z0,x1,y1,z1 separated by ';', instead of "
    "the preset's pins.");
DEFINE_string(
    pin_vertices, "",
    "Fix the vertices of these indices (0,3,7), instead of the preset's pins; "
    "none: fix nothing.");

DEFINE_double(stiffness_field, 0.0,
              "Vary the stiffness over the cloth by a smooth random field: standard "
              "deviation of its logarithm.");
DEFINE_double(
    mass_field, 0.0,
    "Vary the mass over the cloth by a smooth random field: standard deviation "
    "of its logarithm.");
DEFINE_double(field_wave_length, 3.5, "Shortest wave length of the random fields, m.");
DEFINE_uint32(seed, 1, "Seed of the random fields.");

DEFINE_double(delta, 0.02, "Length of a frame, s.");
DEFINE_int32(frames, 0, "Number of frames; 0: the preset's.");
DEFINE_string(integrator, "linearly_implicit_euler",
              "Integration method, by name or number.");
DEFINE_int32(steps_per_frame, 1, "Integration steps in a frame.");
DEFINE_string(settings, "nL",
              "What to estimate, two letters (mass, stiffness) of n, G, L, R.");
DEFINE_string(wind, "", "Wind x,y,z in m/s; empty: the preset's.");
DEFINE_string(collider_sphere, "",
              "Spheres x,y,z,r (centre and radius, m) separated by ';'.");

namespace dpe::tools {
namespace {

ClothMaterial MaterialFromFlags() {
  ClothMaterial material;
  material.traction_stiffness = FLAGS_traction_stiffness;
  material.shear_stiffness = FLAGS_shear_stiffness;
  material.bending_stiffness = FLAGS_bending_stiffness;
  material.density = FLAGS_density;
  material.damping = FLAGS_damping;
  material.drag_coefficient = FLAGS_drag;
  return material;
}

Scene SceneOfShape() {
  const ScenePreset preset = ScenePresetFromName(FLAGS_preset);
  const ClothMaterial material = MaterialFromFlags();
  if (FLAGS_mesh.empty()) {
    return MakePresetScene(preset, {FLAGS_rows, FLAGS_cols, FLAGS_size, material});
  }
  for (const char* flag : {"rows", "cols", "size"}) {
    if (FlagIsGiven(flag)) {
      throw SceneError("--" + std::string(flag) +
                       " is about the grid; --mesh replaces the grid");
    }
  }
  return MakeClothScene(preset, BuildClothFromMesh(LoadObjMesh(FLAGS_mesh), material));
}

void ApplyPins(ClothObject* cloth) {
  if (FLAGS_pin_box.empty() && FLAGS_pin_vertices.empty()) return;
  UnpinAll(cloth);
  for (const std::string& box : Split(FLAGS_pin_box, ';')) {
    const std::vector<double> c = ParseNumbers("pin_box", box, 6);
    if (PinBox({c[0], c[1], c[2]}, {c[3], c[4], c[5]}, cloth) == 0) {
      throw SceneError("--pin_box: there is no vertex in the box " + box);
    }
  }
  if (FLAGS_pin_vertices == "none") return;
  PinVertices(ParseIndices("pin_vertices", FLAGS_pin_vertices), cloth);
}

void ApplySceneFlags(Scene* scene) {
  scene->delta = FLAGS_delta;
  if (FLAGS_frames != 0) scene->num_frames = FLAGS_frames;
  scene->steps_per_frame = FLAGS_steps_per_frame;
  scene->integration_method = IntegrationMethodFromName(FLAGS_integrator);
  if (!FLAGS_wind.empty()) scene->wind = ParseVector3("wind", FLAGS_wind);
  for (const std::string& sphere : Split(FLAGS_collider_sphere, ';')) {
    const std::vector<double> c = ParseNumbers("collider_sphere", sphere, 4);
    scene->colliders.push_back(SphereCollider({c[0], c[1], c[2]}, c[3]));
  }
  ApplySettings(FLAGS_settings, scene);
}

int Main() {
  RequireFlag("output", FLAGS_output, "the scene file to write");
  Scene scene = SceneOfShape();
  ClothObject& cloth = scene.objects[0];
  ApplyPins(&cloth);
  VaryMaterial(
      {FLAGS_stiffness_field, FLAGS_mass_field, FLAGS_field_wave_length, FLAGS_seed},
      &cloth);
  ApplySceneFlags(&scene);

  std::vector<std::string> warnings;
  ValidateScene(scene, FLAGS_output, &warnings);
  for (const std::string& warning : warnings) {
    std::cerr << "make_scene: warning: " << warning << "\n";
  }
  SaveScene(scene, FLAGS_output);
  std::cout << FLAGS_output << ": " << cloth.num_vertices() << " vertices, "
            << cloth.num_springs() << " springs, " << cloth.triangles.size()
            << " triangles, " << scene.num_frames << " frames\n";
  return 0;
}

}  // namespace
}  // namespace dpe::tools

int main(int argc, char** argv) {
  return dpe::tools::RunMain(
      argc, argv,
      {"make_scene", "Writes a scene file with one cloth.",
       "--preset side|corners|flag|flag_no_wind --output FILE [flags]", __FILE__},
      dpe::tools::Main);
}
