#include "dpe/engine/scene_io.h"
#include "fuzz/call_order_calls.h"

namespace dpe::test {
namespace {

constexpr Kind kScene = Kind::kScene;

// A function that creates a scene; several come first, so that there are scenes.
OneCall Create(const char* name, dpe_status (*create)(CallOrderPlayer*, dpe_scene*)) {
  return [=](CallOrderPlayer* p) {
    dpe_scene scene = 0;
    const dpe_status status = create(p, p->OrNull(&scene));
    p->Check(name, status);
    if (status == DPE_OK) p->Remember(scene, kScene);
  };
}

dpe_status FromFile(CallOrderPlayer* p, dpe_scene* scene) {
  return dpe_scene_create_from_file(DPE_C_VERSION + (p->Byte() == 255), p->Path(),
                                    scene);
}

dpe_status FromJson(CallOrderPlayer* p, dpe_scene* scene) {
  static const std::string text = SceneToJson(LoadScene(p->files().scene));
  const char* const texts[] = {text.c_str(), text.c_str(), "{", nullptr};
  return dpe_scene_create_from_json(DPE_C_VERSION, texts[p->Byte() % 4], scene);
}

template <class Number, class Get>
OneCall GetNumbers(const char* name, Get get) {
  return OnHandle(name, kScene, [=](CallOrderPlayer* p, dpe_scene scene) {
    dpe_status status = DPE_OK;
    const int object = p->Int() % 3;
    p->WithBuffer<Number>(name, [&](Number* buffer, int size, int* count) {
      status = get(scene, object, buffer, size, count);
    });
    return status;
  });
}

template <class Get>
OneCall GetText(const char* name, Get get) {
  return OnHandle(name, kScene, [=](CallOrderPlayer* p, dpe_scene scene) {
    dpe_status status = DPE_OK;
    p->WithBuffer<char>(name, [&](char* buffer, int size, int* length) {
      status = get(scene, buffer, size, length);
    });
    return status;
  });
}

dpe_status CopyPositions(CallOrderPlayer* p, dpe_scene scene) {
  dpe_status status = DPE_OK;
  std::uint64_t sequence = p->Byte() % 4;
  std::int64_t frame = 0;
  std::int32_t is_new = 0;
  const int object = p->Int();
  p->WithBuffer<float>("dpe_scene_copy_positions", [&](float* to, int size, int*) {
    status = dpe_scene_copy_positions(scene, object, to, size, p->OrNull(&sequence),
                                      p->OrNull(&frame), p->OrNull(&is_new));
  });
  return status;
}

}  // namespace

std::vector<OneCall> SceneCalls() {
  std::vector<OneCall> calls(4, Create("dpe_scene_create_from_file", FromFile));
  const std::vector<OneCall> others = {
      Create("dpe_scene_create_from_json", FromJson),
      GetText("dpe_scene_warnings", dpe_scene_warnings),
      OnHandle("dpe_scene_get_info", kScene,
               [](CallOrderPlayer* p, dpe_scene scene) {
                 dpe_scene_info info;
                 return dpe_scene_get_info(scene, p->OrNull(&info));
               }),
      OnHandle("dpe_scene_get_object_info", kScene,
               [](CallOrderPlayer* p, dpe_scene scene) {
                 dpe_object_info info;
                 const int object = p->Int();
                 return dpe_scene_get_object_info(scene, object, p->OrNull(&info));
               }),
      GetNumbers<std::int32_t>("dpe_scene_get_triangles", dpe_scene_get_triangles),
      GetNumbers<std::int32_t>("dpe_scene_get_springs", dpe_scene_get_springs),
      GetNumbers<std::uint8_t>("dpe_scene_get_fixed", dpe_scene_get_fixed),
      OnHandle("dpe_scene_step", kScene,
               [](CallOrderPlayer* p, dpe_scene scene) {
                 const int byte = p->Byte();
                 return dpe_scene_step(scene, byte == 255 ? -1 : byte % 4);
               }),
      OnHandle("dpe_scene_start", kScene,
               [](CallOrderPlayer*, dpe_scene s) { return dpe_scene_start(s); }),
      OnHandle("dpe_scene_pause", kScene,
               [](CallOrderPlayer*, dpe_scene s) { return dpe_scene_pause(s); }),
      OnHandle("dpe_scene_stop", kScene,
               [](CallOrderPlayer*, dpe_scene s) { return dpe_scene_stop(s); }),
      OnHandle("dpe_scene_set_rate", kScene,
               [](CallOrderPlayer* p, dpe_scene scene) {
                 return dpe_scene_set_rate(scene, p->Number());
               }),
      OnHandle("dpe_scene_copy_positions", kScene, CopyPositions),
      GetText("dpe_scene_to_json", dpe_scene_to_json),
      OnHandle("dpe_scene_save", kScene,
               [](CallOrderPlayer* p, dpe_scene scene) {
                 const std::string path = p->files().folder + "/saved.txt";
                 return dpe_scene_save(
                     scene, p->Byte() % 2 == 0 ? path.c_str() : "nowhere/at/all");
               }),
  };
  calls.insert(calls.end(), others.begin(), others.end());
  return calls;
}

}  // namespace dpe::test
