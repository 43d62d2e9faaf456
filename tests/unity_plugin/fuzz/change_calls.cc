#include "fuzz/call_order_calls.h"

namespace dpe::test {
namespace {

constexpr Kind kScene = Kind::kScene;

std::vector<double> Numbers(CallOrderPlayer* p, int count) {
  std::vector<double> numbers(count);
  const double value = p->Number();
  for (double& number : numbers) number = value;
  if (count > 0) numbers[p->Byte() % count] = p->Number();
  return numbers;
}

dpe_status GetParameter(CallOrderPlayer* p, dpe_scene scene) {
  dpe_status status = DPE_OK;
  const int object = p->Int(), kind = p->Int();
  p->WithBuffer<double>("dpe_scene_get_parameter", [&](double* to, int size, int* n) {
    status = dpe_scene_get_parameter(scene, object, kind, to, size, n);
  });
  return status;
}

dpe_status SetParameter(CallOrderPlayer* p, dpe_scene scene) {
  static constexpr int kCounts[] = {1, 1, 3, 9, 24, 0};
  const int object = p->Int() % 2, kind = p->Int() % 6;
  const std::vector<double> values = Numbers(p, kCounts[p->Byte() % 6]);
  return dpe_scene_set_parameter(scene, object, kind, p->OrNull(values.data()),
                                 static_cast<int>(values.size()));
}

dpe_collider Collider(CallOrderPlayer* p) {
  dpe_collider collider = {};
  collider.type = p->Int() % 3;
  collider.position[1] = p->Number();
  collider.rotation_degrees[2] = p->Number();
  collider.radius = p->Number();
  collider.stiffness = 100.0 * p->Number();
  return collider;
}

dpe_status MoveVertices(CallOrderPlayer* p, dpe_scene scene) {
  const int vertices[] = {p->Int(), p->Int()};
  const std::vector<double> positions = Numbers(p, 6);
  const int object = p->Int() % 2;
  const int count = p->Byte() % 4 - 1;
  return dpe_scene_move_vertices(scene, object, p->OrNull(vertices),
                                 p->OrNull(positions.data()), count > 2 ? 2 : count);
}

}  // namespace

std::vector<OneCall> ChangeCalls() {
  return {
      OnHandle("dpe_scene_get_parameter", kScene, GetParameter),
      OnHandle("dpe_scene_set_parameter", kScene, SetParameter),
      OnHandle("dpe_scene_load_optimized", kScene,
               [](CallOrderPlayer* p, dpe_scene scene) {
                 return dpe_scene_load_optimized(scene, p->Path());
               }),
      OnHandle("dpe_scene_add_collider", kScene,
               [](CallOrderPlayer* p, dpe_scene scene) {
                 const dpe_collider collider = Collider(p);
                 std::int32_t id = 0;
                 return dpe_scene_add_collider(scene, p->OrNull(&collider),
                                               p->OrNull(&id));
               }),
      OnHandle("dpe_scene_set_collider", kScene,
               [](CallOrderPlayer* p, dpe_scene scene) {
                 const dpe_collider collider = Collider(p);
                 const int id = p->Int() % 4;
                 return dpe_scene_set_collider(scene, id, p->OrNull(&collider));
               }),
      OnHandle("dpe_scene_get_collider", kScene,
               [](CallOrderPlayer* p, dpe_scene scene) {
                 dpe_collider collider;
                 const int id = p->Int();
                 return dpe_scene_get_collider(scene, id, p->OrNull(&collider));
               }),
      OnHandle("dpe_scene_remove_collider", kScene,
               [](CallOrderPlayer* p, dpe_scene scene) {
                 return dpe_scene_remove_collider(scene, p->Int());
               }),
      OnHandle("dpe_scene_get_collider_ids", kScene,
               [](CallOrderPlayer* p, dpe_scene scene) {
                 dpe_status status = DPE_OK;
                 p->WithBuffer<std::int32_t>(
                     "dpe_scene_get_collider_ids", [&](auto* to, int size, int* n) {
                       status = dpe_scene_get_collider_ids(scene, to, size, n);
                     });
                 return status;
               }),
      OnHandle("dpe_scene_move_vertices", kScene, MoveVertices),
      OnHandle("dpe_scene_set_fixed", kScene,
               [](CallOrderPlayer* p, dpe_scene scene) {
                 const int object = p->Int() % 2, vertex = p->Int();
                 return dpe_scene_set_fixed(scene, object, vertex, p->Byte() % 2);
               }),
  };
}

}  // namespace dpe::test
