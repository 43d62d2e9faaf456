#include <string>
#include <vector>

#include "blas_threads.h"
#include "builder_handle.h"
#include "call.h"
#include "dpe/dpe_c.h"
#include "dpe/engine/cloth_builder.h"
#include "scene_handle.h"

using dpe::ClothObject;
using dpe::Scene;
using dpe::c::BuilderHandle;
using dpe::c::CallWith;
using dpe::c::Require;
using dpe::c::RequireFinite;
using dpe::c::RequireIndex;

namespace {

template <class Work>
dpe_status Change(dpe_builder builder, const Work& work) {
  return CallWith<BuilderHandle>(builder, [&](BuilderHandle& b) { b.Change(work); });
}

ClothObject& ObjectOf(Scene* scene, int object) {
  RequireIndex("object", object, static_cast<int>(scene->objects.size()));
  return scene->objects[object];
}

dpe::ClothMaterial ToMaterial(const dpe_material& material) {
  return {material.traction_stiffness,
          material.bending_stiffness,
          material.shear_stiffness,
          material.density,
          material.damping,
          material.drag};
}

dpe::TriangleMesh ToMesh(const double* positions, int num_positions,
                         const int32_t* triangles, int num_indices) {
  Require(positions != nullptr && triangles != nullptr, "the mesh is null");
  Require(num_positions >= 0 && num_positions % 3 == 0 && num_indices >= 0 &&
              num_indices % 3 == 0,
          "sizes of a mesh; accepted are multiples of 3");
  dpe::TriangleMesh mesh;
  mesh.positions = Eigen::VectorXd::Map(positions, num_positions);
  mesh.triangles.resize(num_indices / 3);
  for (int i = 0; i < num_indices; ++i) mesh.triangles[i / 3][i % 3] = triangles[i];
  return mesh;
}

}  // namespace

dpe_status dpe_builder_create(uint32_t header_version, dpe_builder* builder) {
  return dpe::c::CreateWith<BuilderHandle>(builder, [&] {
    dpe::c::RequireVersion(header_version);
    return std::make_shared<BuilderHandle>();
  });
}

dpe_status dpe_builder_destroy(dpe_builder builder) {
  return dpe::c::Destroy<BuilderHandle>(builder);
}

dpe_status dpe_material_default(dpe_material* material) {
  return dpe::c::Call([&] {
    Require(material != nullptr, "the material is null");
    const dpe::ClothMaterial m;
    *material = {m.traction_stiffness,
                 m.bending_stiffness,
                 m.shear_stiffness,
                 m.density,
                 m.damping,
                 m.drag_coefficient};
  });
}

dpe_status dpe_builder_add_mesh(dpe_builder builder, const double* positions,
                                int32_t num_positions, const int32_t* triangles,
                                int32_t num_indices, const dpe_material* material,
                                int32_t* object) {
  return Change(builder, [&](Scene& scene) {
    scene.objects.push_back(dpe::BuildClothFromMesh(
        ToMesh(positions, num_positions, triangles, num_indices),
        material != nullptr ? ToMaterial(*material) : dpe::ClothMaterial()));
    if (object != nullptr) *object = static_cast<int32_t>(scene.objects.size()) - 1;
  });
}

dpe_status dpe_builder_pin_box(dpe_builder builder, int32_t object, const double* lower,
                               const double* upper, int32_t* count) {
  return Change(builder, [&](Scene& scene) {
    RequireFinite("lower", lower, 3);
    RequireFinite("upper", upper, 3);
    for (int i = 0; i < 3; ++i) Require(lower[i] <= upper[i], "lower is above upper");
    const int pinned =
        dpe::PinBox(Eigen::Vector3d::Map(lower), Eigen::Vector3d::Map(upper),
                    &ObjectOf(&scene, object));
    if (count != nullptr) *count = pinned;
  });
}

dpe_status dpe_builder_pin_vertices(dpe_builder builder, int32_t object,
                                    const int32_t* vertices, int32_t count) {
  return Change(builder, [&](Scene& scene) {
    Require(count >= 0 && (count == 0 || vertices != nullptr), "the vertices are null");
    ClothObject& cloth = ObjectOf(&scene, object);
    for (int i = 0; i < count; ++i) {
      RequireIndex("vertex", vertices[i], cloth.num_vertices());
    }
    dpe::PinVertices(std::vector<int>(vertices, vertices + count), &cloth);
  });
}

dpe_status dpe_builder_add_collider(dpe_builder builder, const dpe_collider* collider) {
  return Change(builder, [&](Scene& scene) {
    Require(collider != nullptr, "the collider is null");
    scene.colliders.push_back(dpe::c::ToCollider(*collider));
  });
}

dpe_status dpe_builder_set_wind(dpe_builder builder, const double* wind) {
  return Change(builder, [&](Scene& scene) {
    RequireFinite("wind", wind, 3);
    scene.wind = Eigen::Vector3d::Map(wind);
  });
}

dpe_status dpe_builder_set_time(dpe_builder builder, double frame_length,
                                int32_t steps_per_frame, int32_t num_frames) {
  return Change(builder, [&](Scene& scene) {
    RequireFinite("frame_length", &frame_length, 1);
    Require(frame_length > 0.0, "frame_length; accepted is a number above 0 s");
    Require(steps_per_frame >= 1, "steps_per_frame; accepted are 1 and more");
    Require(num_frames >= 2, "num_frames; accepted are 2 and more");
    scene.delta = frame_length;
    scene.steps_per_frame = steps_per_frame;
    scene.num_frames = num_frames;
  });
}

dpe_status dpe_builder_set_settings(dpe_builder builder, const char* settings) {
  return Change(builder, [&](Scene& scene) {
    dpe::c::RequireText("settings", settings);
    dpe::ApplySettings(settings, &scene);
  });
}

dpe_status dpe_builder_set_method(dpe_builder builder, const char* title,
                                  const char* integration_method) {
  return Change(builder, [&](Scene& scene) {
    if (title != nullptr) {
      dpe::c::RequireText("the title", title);
      scene.title = title;
    }
    if (integration_method != nullptr) {
      dpe::c::RequireText("the method", integration_method);
      scene.integration_method = dpe::IntegrationMethodFromName(integration_method);
    }
  });
}

dpe_status dpe_builder_build(dpe_builder builder, dpe_scene* scene) {
  return CallWith<BuilderHandle>(builder, [&](BuilderHandle& b) {
    Require(scene != nullptr, "the pointer that receives the scene is null");
    dpe::c::UseOneBlasThread();
    const auto made = std::make_shared<dpe::c::SceneHandle>(b.scene(), "");
    *scene = dpe::c::HandleTable::Global().Add(dpe::c::SceneHandle::kKind, made);
  });
}
