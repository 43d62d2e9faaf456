#include <string>
#include <vector>

#include "blas_threads.h"
#include "call.h"
#include "dpe/dpe_c.h"
#include "dpe/engine/scene_io.h"
#include "scene_handle.h"

using dpe::ClothObject;
using dpe::Scene;
using dpe::c::CallWith;
using dpe::c::CopyNumbers;
using dpe::c::CopyText;
using dpe::c::CreateWith;
using dpe::c::Require;
using dpe::c::RequireIndex;
using dpe::c::SceneHandle;
using dpe::c::SceneModel;

namespace {

const ClothObject& ObjectOf(const SceneHandle& scene, int object) {
  RequireIndex("object", object, static_cast<int>(scene.initial().objects.size()));
  return scene.initial().objects[object];
}

std::string Lines(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : "\n") + line;
  return text;
}

template <std::size_t N>
void CopyTuples(const std::vector<std::array<int, N>>& from, int32_t* to, int capacity,
                int32_t* count) {
  const int* first = from.empty() ? nullptr : from[0].data();
  CopyNumbers(first, static_cast<long>(N * from.size()), to, capacity, count);
}

// load(warnings) gives the scene.
template <class Load>
dpe_status Create(uint32_t version, dpe_scene* scene, const Load& load) {
  return CreateWith<SceneHandle>(scene, [&] {
    dpe::c::RequireVersion(version);
    dpe::c::UseOneBlasThread();
    std::vector<std::string> warnings;
    const Scene loaded = load(&warnings);
    return std::make_shared<SceneHandle>(loaded, Lines(warnings));
  });
}

Scene Changed(SceneHandle* scene) {
  Scene changed;
  scene->Change([&](const SceneModel& model) { changed = model.Changed(); });
  return changed;
}

}  // namespace

dpe_status dpe_scene_create_from_file(uint32_t header_version, const char* path,
                                      dpe_scene* scene) {
  return Create(header_version, scene, [&](std::vector<std::string>* warnings) {
    dpe::c::RequireText("the path", path);
    return dpe::LoadScene(path, warnings);
  });
}

dpe_status dpe_scene_create_from_json(uint32_t header_version, const char* json,
                                      dpe_scene* scene) {
  return Create(header_version, scene, [&](std::vector<std::string>* warnings) {
    dpe::c::RequireText("the text", json);
    return dpe::ParseScene(json, "scene", warnings);
  });
}

dpe_status dpe_scene_destroy(dpe_scene scene) {
  return dpe::c::Destroy<SceneHandle>(scene);
}

dpe_status dpe_scene_warnings(dpe_scene scene, char* buffer, int32_t capacity,
                              int32_t* length) {
  return CallWith<SceneHandle>(
      scene, [&](SceneHandle& s) { CopyText(s.warnings(), buffer, capacity, length); });
}

dpe_status dpe_scene_get_info(dpe_scene scene, dpe_scene_info* info) {
  return CallWith<SceneHandle>(scene, [&](SceneHandle& s) {
    Require(info != nullptr, "the info is null");
    *info = s.Info();
  });
}

dpe_status dpe_scene_get_object_info(dpe_scene scene, int32_t object,
                                     dpe_object_info* info) {
  return CallWith<SceneHandle>(scene, [&](SceneHandle& s) {
    Require(info != nullptr, "the info is null");
    ObjectOf(s, object);
    s.Change([&](const SceneModel& model) {
      const ClothObject& cloth = model.now().objects[object];
      *info = {cloth.num_vertices(), static_cast<int32_t>(cloth.triangles.size()),
               cloth.num_springs(), 0};
      for (char is_fixed : cloth.is_fixed) info->num_fixed += is_fixed != 0;
    });
  });
}

dpe_status dpe_scene_get_triangles(dpe_scene scene, int32_t object, int32_t* vertices,
                                   int32_t capacity, int32_t* count) {
  return CallWith<SceneHandle>(scene, [&](SceneHandle& s) {
    CopyTuples(ObjectOf(s, object).triangles, vertices, capacity, count);
  });
}

dpe_status dpe_scene_get_springs(dpe_scene scene, int32_t object, int32_t* vertices,
                                 int32_t capacity, int32_t* count) {
  return CallWith<SceneHandle>(scene, [&](SceneHandle& s) {
    CopyTuples(ObjectOf(s, object).springs, vertices, capacity, count);
  });
}

dpe_status dpe_scene_get_fixed(dpe_scene scene, int32_t object, uint8_t* flags,
                               int32_t capacity, int32_t* count) {
  return CallWith<SceneHandle>(scene, [&](SceneHandle& s) {
    ObjectOf(s, object);
    s.Change([&](const SceneModel& model) {
      const std::vector<char>& fixed = model.now().objects[object].is_fixed;
      CopyNumbers(reinterpret_cast<const uint8_t*>(fixed.data()),
                  static_cast<long>(fixed.size()), flags, capacity, count);
    });
  });
}

dpe_status dpe_scene_step(dpe_scene scene, int32_t num_frames) {
  return CallWith<SceneHandle>(scene, [&](SceneHandle& s) { s.Step(num_frames); });
}

dpe_status dpe_scene_start(dpe_scene scene) {
  return CallWith<SceneHandle>(scene, [](SceneHandle& s) { s.Start(); });
}

dpe_status dpe_scene_pause(dpe_scene scene) {
  return CallWith<SceneHandle>(scene, [](SceneHandle& s) { s.Pause(); });
}

dpe_status dpe_scene_stop(dpe_scene scene) {
  return CallWith<SceneHandle>(scene, [](SceneHandle& s) { s.Stop(); });
}

dpe_status dpe_scene_set_rate(dpe_scene scene, double rate) {
  return CallWith<SceneHandle>(scene, [&](SceneHandle& s) { s.SetRate(rate); });
}

dpe_status dpe_scene_copy_positions(dpe_scene scene, int32_t object, float* positions,
                                    int32_t capacity, uint64_t* sequence,
                                    int64_t* frame, int32_t* is_new) {
  return CallWith<SceneHandle>(scene, [&](SceneHandle& s) {
    dpe::c::CopyPositions(s.positions(), object, positions, capacity, sequence, frame,
                          is_new);
  });
}

dpe_status dpe_scene_to_json(dpe_scene scene, char* buffer, int32_t capacity,
                             int32_t* length) {
  return CallWith<SceneHandle>(scene, [&](SceneHandle& s) {
    CopyText(dpe::SceneToJson(Changed(&s)), buffer, capacity, length);
  });
}

dpe_status dpe_scene_save(dpe_scene scene, const char* path) {
  return CallWith<SceneHandle>(scene, [&](SceneHandle& s) {
    dpe::c::RequireText("the path", path);
    dpe::SaveScene(Changed(&s), path);
  });
}
