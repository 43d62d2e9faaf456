// Priors and smoothness through estimate_cloth.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/estimate_cloth_support.h"

namespace dpe::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

using EstimateClothPriorsTest = EstimateClothTest;

TEST_F(EstimateClothPriorsTest, APriorIsInTheFitAndInTheReport) {
  const ProgramResult result =
      Run({"--settings=nR", "--estimate=damping", "--noise_sigma=0.002", "--seed=4",
           "--prior=damping:lognormal:0.5,1e-4;stiffness[bend]:normal:3,100"});
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  const nlohmann::json report = Report();
  EXPECT_NEAR(report.at("parameters")[1].at("values")[0].get<double>(), 0.5, 1e-3);
  EXPECT_EQ(report.at("priors")[0], "damping:lognormal:0.5,0.0001");
  EXPECT_GT(report.at("prior_cost").get<double>(), 0.0);
  EXPECT_THAT(result.out, HasSubstr("damping of object 0 is determined by its prior "
                                    "alone: the data add next to nothing"));
}

TEST_F(EstimateClothPriorsTest, TheWeightsThatWereTriedAreInOutputAndReport) {
  const ProgramResult result =
      Run({"--init=uniform:20", "--noise_sigma=0.005", "--smoothness=stiffness=auto"});
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  EXPECT_THAT(result.out, AllOf(HasSubstr("held-out cost"), HasSubstr("  chosen\n"),
                                HasSubstr("best from the first 16")));
  const nlohmann::json report = Report().at("smoothness");
  const nlohmann::json& candidates = report.at("candidates");
  ASSERT_GE(candidates.size(), 3u);
  EXPECT_EQ(candidates[0].at("weight"), 1e6);
  int chosen = 0;
  for (const nlohmann::json& candidate : candidates) {
    EXPECT_GT(candidate.at("held_out_cost").get<double>(), 0.0);
    chosen += candidate.at("chosen").get<bool>();
  }
  EXPECT_EQ(chosen, 1);
  EXPECT_THAT(report.at("priors")[0].get<std::string>(), HasSubstr("stiffness=auto:"));
}

TEST_F(EstimateClothPriorsTest, BadOnesAreRefused) {
  const auto refused = [&](const std::vector<std::string>& flags) {
    const ProgramResult result = Run(flags);
    EXPECT_EQ(result.exit_code, 1) << result.out;
    return result.err;
  };
  EXPECT_THAT(refused({"--prior=stiff:normal:1,1"}),
              AllOf(HasSubstr("--prior"), HasSubstr("stiff:normal:1,1"),
                    HasSubstr("mass, stiffness")));
  EXPECT_THAT(refused({"--smoothness=stiffness"}),
              AllOf(HasSubstr("--smoothness"), HasSubstr("WEIGHT")));
  EXPECT_THAT(refused({"--prior=mass:normal:1,1", "--sigma=0.01"}),
              AllOf(HasSubstr("mass:normal:1,1"), HasSubstr("not estimated")));
  EXPECT_THAT(refused({"--prior=stiffness:normal:1,0", "--sigma=0.01"}),
              HasSubstr("spread"));
  EXPECT_THAT(refused({"--prior=stiffness:normal:1,1"}), HasSubstr("--sigma"));
  EXPECT_THAT(refused({"--smoothness=stiffness=3", "--settings=nG", "--sigma=0.01"}),
              HasSubstr("mode L"));
}

}  // namespace
}  // namespace dpe::test
