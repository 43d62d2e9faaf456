#include <gtest/gtest.h>

#include "c_api_support.h"
#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/scene_io.h"

namespace dpe::test {
namespace {

std::string JsonOf(dpe_scene scene) {
  std::int32_t length = 0;
  EXPECT_EQ(dpe_scene_to_json(scene, nullptr, 0, &length), DPE_ERROR_BUFFER);
  std::vector<char> text(length + 1);
  EXPECT_DPE_OK(dpe_scene_to_json(scene, text.data(), length + 1, nullptr));
  return text.data();
}

TEST(BuilderApiTest, MakesThePresetsScene) {
  const TriangleMesh mesh = MakeGrid(6, 6, 7.0, GridPlane::kXZ);
  OwnedHandle builder{dpe_builder_destroy};
  ASSERT_DPE_OK(dpe_builder_create(DPE_C_VERSION, &builder));
  std::int32_t object = -1, pinned = 0;
  ASSERT_DPE_OK(dpe_builder_add_mesh(
      builder, mesh.positions.data(), static_cast<std::int32_t>(mesh.positions.size()),
      mesh.triangles[0].data(), static_cast<std::int32_t>(3 * mesh.triangles.size()),
      nullptr, &object));
  EXPECT_EQ(object, 0);
  const double lower[] = {-4, -1, 3.4}, upper[] = {4, 1, 4};
  ASSERT_DPE_OK(dpe_builder_pin_box(builder, object, lower, upper, &pinned));
  EXPECT_EQ(pinned, 6);
  ASSERT_DPE_OK(dpe_builder_set_time(builder, 0.02, 1, 100));
  ASSERT_DPE_OK(dpe_builder_set_settings(builder, "nL"));
  ASSERT_DPE_OK(dpe_builder_set_method(builder, "side", "linearly_implicit_euler"));
  OwnedScene scene;
  ASSERT_DPE_OK(dpe_builder_build(builder, &scene));
  PresetOptions options;
  options.rows = options.cols = 6;
  Scene expected = MakePresetScene(ScenePreset::kSide, options);
  ApplySettings("nL", &expected);
  expected.title = "side";
  expected.print_times = false;
  EXPECT_EQ(JsonOf(scene), SceneToJson(expected));
}

TEST(BuilderApiTest, FailuresChangeNothing) {
  OwnedHandle builder{dpe_builder_destroy};
  ASSERT_DPE_OK(dpe_builder_create(DPE_C_VERSION, &builder));
  OwnedScene scene;
  EXPECT_EQ(dpe_builder_build(builder, &scene), DPE_ERROR_INPUT) << "no cloth";
  const double flat[] = {0, 0, 0, 1, 0, 0, 2, 0, 0};
  const double good[] = {0, 0, 0, 1, 0, 0, 0, 0, 1};
  const std::int32_t triangle[] = {0, 1, 2};
  EXPECT_EQ(dpe_builder_add_mesh(builder, flat, 9, triangle, 3, nullptr, nullptr),
            DPE_ERROR_INPUT);
  EXPECT_EQ(dpe_builder_add_mesh(builder, good, 8, triangle, 3, nullptr, nullptr),
            DPE_ERROR_ARGUMENT);
  std::int32_t object = -1;
  ASSERT_DPE_OK(dpe_builder_add_mesh(builder, good, 9, triangle, 3, nullptr, &object));
  EXPECT_EQ(object, 0) << "the failed ones have left nothing";
  EXPECT_EQ(dpe_builder_set_settings(builder, "nL,nL"), DPE_ERROR_INPUT);
  EXPECT_EQ(dpe_builder_pin_vertices(builder, 0, triangle, 1), DPE_OK);
  const std::int32_t outside = 3;
  EXPECT_EQ(dpe_builder_pin_vertices(builder, 0, &outside, 1), DPE_ERROR_ARGUMENT);
  ASSERT_DPE_OK(dpe_builder_build(builder, &scene));
  dpe_object_info info;
  ASSERT_DPE_OK(dpe_scene_get_object_info(scene, 0, &info));
  EXPECT_EQ(info.num_fixed, 1);
}

}  // namespace
}  // namespace dpe::test
