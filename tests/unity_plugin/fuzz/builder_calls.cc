#include "fuzz/call_order_calls.h"

namespace dpe::test {
namespace {

constexpr Kind kBuilder = Kind::kBuilder;

void Create(CallOrderPlayer* p) {
  dpe_builder builder = 0;
  const dpe_status status = dpe_builder_create(DPE_C_VERSION, p->OrNull(&builder));
  p->Check("dpe_builder_create", status);
  if (status == DPE_OK) p->Remember(builder, kBuilder);
}

dpe_status AddMesh(CallOrderPlayer* p, dpe_builder builder) {
  double positions[] = {0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 1};
  int triangles[] = {0, 1, 2, 1, 3, 2};
  if (p->Byte() % 4 == 0) positions[p->Byte() % 12] = p->Number();
  if (p->Byte() % 4 == 0) triangles[p->Byte() % 6] = p->Int();
  dpe_material material;
  p->Check("dpe_material_default", dpe_material_default(&material));
  if (p->Byte() % 4 == 0) material.density = p->Number();
  std::int32_t object = 0;
  const int num_positions = p->Byte() % 4 == 0 ? p->Int() : 12;
  const int num_indices = p->Byte() % 4 == 0 ? p->Int() % 7 : 6;
  return dpe_builder_add_mesh(
      builder, p->OrNull(positions), num_positions > 12 ? 12 : num_positions,
      p->OrNull(triangles), num_indices, p->OrNull(&material), p->OrNull(&object));
}

dpe_status PinBox(CallOrderPlayer* p, dpe_builder builder) {
  const double lower[] = {p->Number(), -1, -1}, upper[] = {p->Number(), 1, p->Number()};
  std::int32_t count = 0;
  const int object = p->Int() % 4;
  return dpe_builder_pin_box(builder, object, p->OrNull(lower), p->OrNull(upper),
                             p->OrNull(&count));
}

dpe_status AddCollider(CallOrderPlayer* p, dpe_builder builder) {
  dpe_collider collider = {};
  collider.type = p->Int() % 3;
  collider.radius = p->Number();
  collider.stiffness = p->Number();
  return dpe_builder_add_collider(builder, p->OrNull(&collider));
}

void Build(CallOrderPlayer* p) {
  const HandleModel builder = *p->Handle(kBuilder);
  dpe_scene scene = 0;
  const dpe_status status = dpe_builder_build(builder.handle, p->OrNull(&scene));
  p->Check("dpe_builder_build", status, builder, kBuilder);
  if (status == DPE_OK) p->Remember(scene, Kind::kScene);
}

}  // namespace

std::vector<OneCall> BuilderCalls() {
  return {
      Create,
      Create,
      Build,
      OnHandle("dpe_builder_add_mesh", kBuilder, AddMesh),
      OnHandle("dpe_builder_pin_box", kBuilder, PinBox),
      OnHandle("dpe_builder_pin_vertices", kBuilder,
               [](CallOrderPlayer* p, dpe_builder builder) {
                 const int vertices[] = {p->Int(), p->Int()};
                 const int object = p->Int() % 4, count = p->Byte() % 4 - 1;
                 return dpe_builder_pin_vertices(builder, object, p->OrNull(vertices),
                                                 count);
               }),
      OnHandle("dpe_builder_add_collider", kBuilder, AddCollider),
      OnHandle("dpe_builder_set_wind", kBuilder,
               [](CallOrderPlayer* p, dpe_builder builder) {
                 const double wind[] = {p->Number(), 0, p->Number()};
                 return dpe_builder_set_wind(builder, p->OrNull(wind));
               }),
      OnHandle("dpe_builder_set_time", kBuilder,
               [](CallOrderPlayer* p, dpe_builder builder) {
                 const double length = p->Number();
                 const int steps = p->Byte() % 4;
                 return dpe_builder_set_time(builder, length, steps, p->Int());
               }),
      OnHandle("dpe_builder_set_settings", kBuilder,
               [](CallOrderPlayer* p, dpe_builder builder) {
                 const char* const kTexts[] = {"nG", "GL", "xx", "", "nn,nG", nullptr};
                 return dpe_builder_set_settings(builder, kTexts[p->Byte() % 6]);
               }),
      OnHandle("dpe_builder_set_method", kBuilder,
               [](CallOrderPlayer* p, dpe_builder builder) {
                 const char* const kTexts[] = {"tr_bdf2", "implicit_euler", "\xFF",
                                               "explicit_euler", nullptr};
                 const char* title = kTexts[p->Byte() % 5];
                 return dpe_builder_set_method(builder, title, kTexts[p->Byte() % 5]);
               }),
  };
}

}  // namespace dpe::test
