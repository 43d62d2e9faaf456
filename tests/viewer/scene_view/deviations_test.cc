#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "scene_view/deviations_io.h"
#include "support/temp_dir.h"
#include "support/test_scenes.h"

namespace dpe::viewer {
namespace {

std::string Report(const std::string& settings, const std::string& kind,
                   const std::string& deviations) {
  return "{\"settings\": \"" + settings +
         "\", \"uncertainty\": {\"ok\": true, \"message\": null, \"parameters\": "
         "[{\"object\": null, \"kind\": \"wind\", \"standard_deviations\": [1, 2, 3]}, "
         "{\"object\": 0, \"kind\": \"" +
         kind + "\", \"standard_deviations\": " + deviations + "}]}}";
}

class DeviationsTest : public testing::Test {
 protected:
  Deviations Read(const std::string& text) {
    test::WriteFile(path_, text);
    return ReadDeviations(path_, scene_);
  }
  void ExpectError(const std::string& text, const std::string& what) {
    try {
      Read(text);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const SceneError& error) {
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos)
          << error.what();
      EXPECT_NE(std::string(error.what()).find(path_), std::string::npos);
    }
  }

  const test::TempDir folder_;
  const std::string path_ = folder_.File("report.json");
  const Scene scene_ = test::MakeDerivativeScene("side", 3);
};

TEST_F(DeviationsTest, OneForAllGroupsAndEachOfTheirOwn) {
  const Deviations global = Read(Report("nG", "stiffness", "[0.5]"));
  EXPECT_TRUE(global.has_stiffness());
  EXPECT_FALSE(global.has_mass());
  const ClothObject& cloth = scene_.objects[0];
  ASSERT_EQ(global.stiffness[0].size(), cloth.num_springs());
  for (int s = 0; s < cloth.num_springs(); ++s) {
    const bool moves =
        !cloth.is_fixed[cloth.springs[s][0]] || !cloth.is_fixed[cloth.springs[s][1]];
    EXPECT_EQ(std::isnan(global.stiffness[0][s]), !moves);
    if (moves) {
      EXPECT_EQ(global.stiffness[0][s], 0.5);
    }
  }
  const Deviations groups = Read(Report("nR", "stiffness", "[1, 2, null]"));
  const std::vector<int> group = SpringGroups(cloth);
  for (int s = 0; s < cloth.num_springs(); ++s) {
    if (std::isnan(groups.stiffness[0][s])) continue;
    const double expected = group[s] < 2 ? group[s] + 1.0 : INFINITY;
    EXPECT_EQ(groups.stiffness[0][s], expected) << s;
  }
  // Six of the nine vertices are free.
  const Deviations local = Read(Report("Ln", "mass", "[1, 2, 3, 4, 5, 6]"));
  EXPECT_EQ(local.mass[0][0], 1.0);
  EXPECT_EQ(local.mass[0][5], 6.0);
  EXPECT_TRUE(std::isnan(local.mass[0][8]));
}

TEST_F(DeviationsTest, SaysWhatIsWrong) {
  ExpectError("{", "is not JSON");
  ExpectError("{}", "not a report");
  ExpectError(Report("nG", "stiffness", "[1, 2]"), "another scene");
  ExpectError(Report("nG", "damping", "[1]"), "neither stiffness nor mass");
  ExpectError(
      "{\"settings\": \"nG\", \"uncertainty\": {\"ok\": false, \"message\": "
      "\"it was turned off\"}}",
      "it was turned off");
  EXPECT_THROW(ReadDeviations(folder_.File("none.json"), scene_), SceneError);
}

}  // namespace
}  // namespace dpe::viewer
