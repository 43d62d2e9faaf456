#include <vector>

#include "call.h"
#include "dpe/dpe_c.h"
#include "dpe/engine/scene_io.h"
#include "scene_handle.h"

using dpe::c::CallWith;
using dpe::c::CopyNumbers;
using dpe::c::Require;
using dpe::c::SceneHandle;
using dpe::c::SceneModel;

namespace {

// work(SceneModel&) between two frames of a scene.
template <class Work>
dpe_status Change(dpe_scene scene, const Work& work) {
  return CallWith<SceneHandle>(scene, [&](SceneHandle& s) { s.Change(work); });
}

}  // namespace

dpe_status dpe_scene_get_parameter(dpe_scene scene, int32_t object, int32_t kind,
                                   double* values, int32_t capacity, int32_t* count) {
  return Change(scene, [&](const SceneModel& model) {
    const std::vector<double> all = model.Parameter(object, kind);
    CopyNumbers(all.data(), static_cast<long>(all.size()), values, capacity, count);
  });
}

dpe_status dpe_scene_set_parameter(dpe_scene scene, int32_t object, int32_t kind,
                                   const double* values, int32_t count) {
  return Change(scene, [&](SceneModel& model) {
    model.SetParameter(object, kind, values, count);
  });
}

dpe_status dpe_scene_load_optimized(dpe_scene scene, const char* path) {
  return CallWith<SceneHandle>(scene, [&](SceneHandle& s) {
    dpe::c::RequireText("the path", path);
    const dpe::Scene loaded = dpe::LoadScene(path);
    s.Change([&](SceneModel& model) { model.TakeParameters(loaded); });
  });
}

dpe_status dpe_scene_add_collider(dpe_scene scene, const dpe_collider* collider,
                                  int32_t* id) {
  return Change(scene, [&](SceneModel& model) {
    Require(collider != nullptr && id != nullptr, "the collider or its id is null");
    *id = model.AddCollider(*collider);
  });
}

dpe_status dpe_scene_set_collider(dpe_scene scene, int32_t id,
                                  const dpe_collider* collider) {
  return Change(scene, [&](SceneModel& model) {
    Require(collider != nullptr, "the collider is null");
    model.SetCollider(id, *collider);
  });
}

dpe_status dpe_scene_get_collider(dpe_scene scene, int32_t id, dpe_collider* collider) {
  return Change(scene, [&](const SceneModel& model) {
    Require(collider != nullptr, "the collider is null");
    *collider = model.GetCollider(id);
  });
}

dpe_status dpe_scene_remove_collider(dpe_scene scene, int32_t id) {
  return Change(scene, [&](SceneModel& model) { model.RemoveCollider(id); });
}

dpe_status dpe_scene_get_collider_ids(dpe_scene scene, int32_t* ids, int32_t capacity,
                                      int32_t* count) {
  return Change(scene, [&](const SceneModel& model) {
    const std::vector<int>& all = model.collider_ids();
    CopyNumbers(all.data(), static_cast<long>(all.size()), ids, capacity, count);
  });
}

dpe_status dpe_scene_move_vertices(dpe_scene scene, int32_t object,
                                   const int32_t* vertices, const double* positions,
                                   int32_t count) {
  return Change(scene, [&](SceneModel& model) {
    model.MoveVertices(object, vertices, positions, count);
  });
}

dpe_status dpe_scene_set_fixed(dpe_scene scene, int32_t object, int32_t vertex,
                               int32_t is_fixed) {
  return Change(
      scene, [&](SceneModel& model) { model.SetFixed(object, vertex, is_fixed != 0); });
}
