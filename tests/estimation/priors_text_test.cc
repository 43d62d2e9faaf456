// Priors from text and back.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dpe/estimation/priors.h"

namespace dpe {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string ErrorOfPrior(const std::string& text) {
  try {
    PriorsFromText(text);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "accepted";
}

std::string ErrorOfSmoothness(const std::string& text) {
  try {
    SmoothnessFromText(text);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(PriorsTextTest, ReadsEveryPartOfAnEntry) {
  const std::vector<Prior> priors = PriorsFromText(
      "stiffness[shear]@1:lognormal:50,0.5;damping:normal:0.1,0.02;wind[z]:normal:-3,"
      "1");
  ASSERT_EQ(priors.size(), 3u);
  EXPECT_EQ(priors[0].kind, ParameterKind::kStiffness);
  EXPECT_EQ(priors[0].part, "shear");
  EXPECT_EQ(priors[0].object, 1);
  EXPECT_EQ(priors[0].distribution, PriorDistribution::kLogNormal);
  EXPECT_EQ(priors[0].centre, 50.0);
  EXPECT_EQ(priors[0].spread, 0.5);
  EXPECT_EQ(priors[1].kind, ParameterKind::kDamping);
  EXPECT_EQ(priors[1].object, -1);
  EXPECT_EQ(priors[1].distribution, PriorDistribution::kNormal);
  EXPECT_EQ(priors[2].part, "z");
  EXPECT_EQ(priors[2].centre, -3.0);
  EXPECT_TRUE(PriorsFromText("").empty());
}

TEST(PriorsTextTest, ReadsBackToTheSame) {
  for (const char* text :
       {"stiffness[shear]@1:lognormal:50,0.5", "mass[3]:normal:0.1,1e-09",
        "initial_velocity[x]@0:normal:0,0.333333333333333",
        "wind:normal:0.10000000000000001,2"}) {
    const std::vector<Prior> priors = PriorsFromText(text);
    const std::vector<Prior> again = PriorsFromText(PriorText(priors[0]));
    EXPECT_EQ(PriorText(again[0]), PriorText(priors[0]));
    EXPECT_EQ(again[0].centre, priors[0].centre);
    EXPECT_EQ(again[0].spread, priors[0].spread);
  }
  EXPECT_EQ(PriorText(PriorsFromText("mass[3]@0:normal:0.1,2")[0]),
            "mass[3]@0:normal:0.1,2");
  const std::string text = "stiffness@0=100,mass=auto,stiffness@1=auto:0.01";
  EXPECT_EQ(SmoothnessText(SmoothnessFromText(text)), text);
  EXPECT_EQ(SmoothnessFromText(text)[1].weight, 0.0);
  EXPECT_TRUE(SmoothnessFromText(text)[1].is_chosen);
  EXPECT_FALSE(SmoothnessFromText(text)[0].is_chosen);
}

TEST(PriorsTextTest, BadPriorsNameTheEntryAndWhatIsAccepted) {
  const std::pair<const char*, const char*> cases[] = {
      {"stiffnes:normal:1,1",
       "mass, stiffness, damping, drag, wind or initial_velocity"},
      {"stiffness:gauss:1,1", "normal or lognormal"},
      {"stiffness:normal:1", "two finite numbers"},
      {"stiffness:normal:1,1,1", "two finite numbers"},
      {"stiffness:normal:1,1x", "two finite numbers"},
      {"stiffness:normal:nan,1", "two finite numbers"},
      {"stiffness:normal: 1,1", "two finite numbers"},
      {"stiffness", "DISTRIBUTION:CENTRE,SPREAD"},
      {"stiffness:normal:1,1:2", "DISTRIBUTION:CENTRE,SPREAD"},
      {"stiffness[warp]:normal:1,1", "stretch, shear, bend or the number of a group"},
      {"stiffness[]:normal:1,1", "[PART]"},
      {"stiffness[bend:normal:1,1", "[PART]"},
      {"mass[bend]:normal:1,1", "the number of a group"},
      {"damping[0]:normal:1,1", "without brackets"},
      {"wind[w]:normal:1,1", "x, y or z"},
      {"wind@0:normal:1,1", "without @"},
      {"mass@-1:normal:1,1", "the number of an object"},
      {"mass@:normal:1,1", "the number of an object"},
      {"mass@1.5:normal:1,1", "the number of an object"}};
  for (const auto& [entry, accepted] : cases) {
    EXPECT_THAT(
        ErrorOfPrior(std::string("drag:normal:1,1;") + entry),
        AllOf(HasSubstr(std::string("\"") + entry + "\""), HasSubstr(accepted)));
  }
  EXPECT_THAT(ErrorOfPrior("drag:normal:1,1;"), HasSubstr("\"\""));
}

TEST(PriorsTextTest, BadSmoothnessNamesTheEntryAndWhatIsAccepted) {
  const std::pair<const char*, const char*> cases[] = {
      {"stiffness", "QUANTITY@OBJECT=WEIGHT"},
      {"stiffness=1=2", "QUANTITY@OBJECT=WEIGHT"},
      {"stiffness=0", "a number above 0"},
      {"stiffness=-3", "a number above 0"},
      {"stiffness=some", "a number above 0"},
      {"stiffness=autos", "a number above 0"},
      {"damping=1", "stiffness or mass"},
      {"stiff=1", "mass, stiffness"},
      {"stiffness[bend]=1", "mass, stiffness"},
      {"stiffness@x=1", "the number of an object"}};
  for (const auto& [entry, accepted] : cases) {
    EXPECT_THAT(
        ErrorOfSmoothness(std::string("mass=1,") + entry),
        AllOf(HasSubstr(std::string("\"") + entry + "\""), HasSubstr(accepted)));
  }
  EXPECT_THAT(ErrorOfSmoothness("mass=1,mass=2"), HasSubstr("given twice"));
  EXPECT_THAT(ErrorOfSmoothness("mass=1,mass@0=2"), HasSubstr("given twice"));
  EXPECT_THAT(ErrorOfSmoothness("mass@0=1,mass=2"), HasSubstr("given twice"));
  EXPECT_EQ(ErrorOfSmoothness("mass@0=1,mass@1=2,stiffness=3"), "accepted");
}

}  // namespace
}  // namespace dpe
