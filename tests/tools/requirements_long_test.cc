// The whole campaign of only_what_it_requires: what is turned off costs nothing, and
// what is turned on is seen in its own code.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "experiments/requirements/cost_job.h"
#include "experiments/requirements/features.h"
#include "experiments/requirements/instruction_count.h"

namespace dpe::experiments {
namespace {

// A second object that is not fitted is still copied and checked, once.
double Noise(const Feature& feature) {
  return feature.off == "fit-second_fixed" ? 0.01 : 0.001;
}

TEST(RequirementsLongTest, WhatIsTurnedOffCostsNothing) {
  std::string why;
  if (!CanCountInstructions(&why)) GTEST_SKIP() << why;
  std::map<std::string, Record> rows;
  for (Job job : CostConfigurations()) {
    job.Set("repetitions", 0);  // no times
    rows[job.Text("id", "")] = CostJobKind().run(job);
  }
  for (const Feature& feature : ComparedFeatures()) {
    const double off = rows[feature.off].Number("instructions", std::nan(""));
    const double on = rows[feature.on].Number("instructions", std::nan(""));
    if (!feature.impossible.empty()) {
      const double none = rows[feature.impossible].Number("instructions", 1.0);
      EXPECT_NEAR(off / none, 1.0, Noise(feature)) << feature.name;
    }
    if (feature.code.empty()) continue;
    const std::string code = "code_" + feature.code;
    const double own_off = rows[feature.off].Number(code, std::nan(""));
    const double own_on = rows[feature.on].Number(code, std::nan(""));
    EXPECT_LT(own_off, 1e-3 * off) << feature.name;
    EXPECT_GT(own_on, own_off) << feature.name;
    EXPECT_LT(own_on, on) << feature.name;
  }
}

}  // namespace
}  // namespace dpe::experiments
