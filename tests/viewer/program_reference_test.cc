// What the program draws of the scenes in data/, against pictures that were looked at.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "picture_difference.h"
#include "png/png.h"
#include "support/run_program.h"
#include "support/temp_dir.h"
#include "vk/device_options.h"

namespace dpe::viewer {
namespace {

using test::ProgramResult;

std::string Data(const std::string& name) {
  return std::string(DPE_SOURCE_DIR) + "/data/" + name + ".txt";
}

class ViewerReferenceTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (ListDevices().empty()) GTEST_SKIP() << "there is no Vulkan device";
  }

  // Frame 30 of a scene.
  Image Draw(const std::string& scene, std::vector<std::string> arguments) {
    const std::string png = folder_.File("picture.png");
    arguments.insert(arguments.begin(),
                     {Data(scene), "--offscreen", "--validation", "--first_frame=30",
                      "--size=640x480", "--png=" + png});
    const ProgramResult result = test::RunProgram("dpe_viewer", arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return ReadPng(png);
  }

  test::TempDir folder_;
};

TEST_F(ViewerReferenceTest, Scenes) {
  for (const char* scene : {"side", "corners", "flag", "flag_no_wind"}) {
    EXPECT_TRUE(MatchesReference(Draw(scene, {}), std::string("scene_") + scene));
  }
}

TEST_F(ViewerReferenceTest, ColorsAreByWhatTheyAreCalled) {
  for (const char* color : {"stiffness", "mass", "stretch", "speed"}) {
    EXPECT_TRUE(MatchesReference(Draw("flag", {std::string("--color=") + color}),
                                 std::string("color_") + color));
  }
}

// Flags with and without wind: the second is the green wireframe, and how far it is
// from the first is the color.
TEST_F(ViewerReferenceTest, ComparedScenes) {
  const std::string other = "--compare=" + Data("flag_no_wind");
  const std::string behind = "--yaw=200";  // where both are seen
  EXPECT_TRUE(MatchesReference(Draw("flag", {other, behind}), "compare"));
  EXPECT_TRUE(MatchesReference(Draw("flag", {other, behind, "--color=distance"}),
                               "color_distance"));
}

// The pictures differ from each other: a wrong scene or color would be noticed.
TEST_F(ViewerReferenceTest, ReferencesAreNotAlike) {
  const std::vector<std::string> names{
      "scene_side",      "scene_corners", "scene_flag",    "scene_flag_no_wind",
      "color_stiffness", "color_mass",    "color_stretch", "color_speed",
      "color_distance",  "compare"};
  std::vector<Image> references;
  for (std::size_t i = 0; i < names.size(); ++i) {
    references.push_back(Reference(names[i]));
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_FALSE(AreAlike(Compare(references[i], references[j])))
          << names[i] << " and " << names[j];
    }
  }
}

}  // namespace
}  // namespace dpe::viewer
