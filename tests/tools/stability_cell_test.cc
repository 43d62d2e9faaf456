// Cells of the stability experiment come to what they must, with reasons by name; and
// derivatives that are wrong on purpose are found out.
#include "experiments/stability/stability_cell.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <string>

#include "experiments/stability/stability.h"
#include "experiments/stability/stability_cells.h"
#include "experiments/stability/stability_report.h"

namespace dpe::experiments {
namespace {

using testing::HasSubstr;

Record RunCell(const std::string& axis, double value, int method,
               const std::string& solver = "cholesky") {
  return RunStabilityCell(
      {axis, value, static_cast<IntegrationMethod>(method), solver});
}

TEST(StabilityCellTest, AtTheBaseAllMethodsAreAccurateAndTheirGradientsRight) {
  for (int method = 0; method < 5; ++method) {
    SCOPED_TRACE(method);
    const Record row = RunCell("stiffness", 50.0, method);
    EXPECT_EQ(row.Text("result", ""), "accurate");
    EXPECT_EQ(row.Text("gradient", ""), "right") << row.Text("gradient_why", "");
    EXPECT_GE(row.Integer("directions_right", 0), 6);
    EXPECT_LT(row.Number("gradient_identity", 1.0), 1e-10);
    // First order: about one step in a hundred; second order much less.
    EXPECT_LT(row.Number("error", 1.0), method == 4 ? 1e-4 : 0.03);
    EXPECT_GT(row.Number("error", 0.0), 1e-7);
    EXPECT_LT(row.Number("reference_error", 1.0), 1e-5);
  }
}

TEST(StabilityCellTest, BeyondTheirLimitExplicitMethodsFailByName) {
  for (int method : {0, 1}) {
    const Record row = RunCell("stiffness", 1e6, method);
    EXPECT_EQ(row.Text("result", ""), "failed");
    EXPECT_THAT(row.Text("why", ""), HasSubstr("is unstable for steps h longer"));
    EXPECT_GT(row.Integer("failed_frame", -1), 0);
    EXPECT_EQ(row.Text("prediction", ""), "unstable");
    EXPECT_EQ(row.Text("agreement", ""), "agrees");
    EXPECT_LT(row.Number("limit", 1.0), 1e-4);
    EXPECT_EQ(row.Text("gradient", "none"), "");
  }
  const Record within = RunCell("stiffness", 1e3, 1);
  EXPECT_EQ(within.Text("prediction", ""), "stable");
  EXPECT_EQ(within.Text("agreement", ""), "agrees");
  EXPECT_GT(within.Number("limit", 0.0), 0.002);
}

TEST(StabilityCellTest, ImplicitMethodsGoOnWhereExplicitOnesFail) {
  for (int method : {2, 3, 4}) {
    for (const char* solver : {"cholesky", "cg"}) {
      SCOPED_TRACE(std::to_string(method) + solver);
      const Record row = RunCell("stiffness", 1e6, method, solver);
      EXPECT_EQ(row.Text("result", ""), "accurate");
      EXPECT_EQ(row.Text("gradient", ""), "right") << row.Text("gradient_why", "");
    }
  }
}

TEST(StabilityCellTest, AStepOfASecondIsStableButInaccurate) {
  for (int method : {2, 3, 4}) {
    const Record row = RunCell("delta", 1.0, method);
    EXPECT_EQ(row.Text("result", ""), "inaccurate") << method;
    EXPECT_GT(row.Number("error", 0.0), 0.05);
    EXPECT_NE(row.Text("gradient", ""), "wrong") << row.Text("gradient_why", "");
  }
}

TEST(StabilityCellTest, VerticesThatMeetAreNamed) {
  for (int method : {0, 1, 2, 3}) {
    const Record row = RunCell("coincident", 0.0, method);
    EXPECT_EQ(row.Text("result", ""), "failed");
    EXPECT_THAT(row.Text("why", ""), HasSubstr("the ends of spring 0"));
  }
}

TEST(StabilityCellTest, ATriangleThatCollapsesIsAKinkAndNotAWrongDerivative) {
  for (int method = 0; method < 5; ++method) {
    const Record row = RunCell("collapse_unit", 0.0, method);
    EXPECT_EQ(row.Text("result", ""), "accurate") << method;
    EXPECT_NE(row.Text("gradient", ""), "wrong") << row.Text("gradient_why", "");
  }
}

TEST(StabilityCellTest, WhatDifferencesCannotSeeIsNotCalledRight) {
  const Record row = RunCell("stiffness", 1e-6, 3);
  EXPECT_EQ(row.Text("gradient", ""), "not decidable");
  EXPECT_THAT(row.Text("gradient_why", ""), HasSubstr("stiffness: its influence"));
  EXPECT_EQ(row.Integer("directions_undecidable", 0), 1);
  EXPECT_GE(row.Integer("directions_right", 0), 5);
}

TEST(StabilityCellTest, FarFromTheOriginTheMotionIsTheSame) {
  for (int method : {1, 3}) {
    const Record near = RunCell("stiffness", 50.0, method),
                 far = RunCell("shift", 1e6, method);
    EXPECT_EQ(far.Text("result", ""), "accurate");
    EXPECT_NEAR(far.Number("error", 1.0), near.Number("error", 0.0), 1e-4);
  }
}

TEST(StabilityCellTest, AnAxisThatThereIsNotIsRefused) {
  const Record row = RunCell("colour", 1.0, 3);
  EXPECT_EQ(row.Text("result", ""), "refused");
  EXPECT_THAT(row.Text("why", ""), HasSubstr("\"colour\""));
}

// Derivatives that are wrong in one way each.
Record RunPoisoned(const std::function<void(Derivatives*)>& poison,
                   const std::string& axis = "stiffness", double value = 1e3) {
  return RunStabilityCell(
      {axis, value, IntegrationMethod::kImplicitEuler, "cholesky"},
      [&](Simulator* simulator, const Rollout& rollout, const Eigen::MatrixXd& weights,
          const std::vector<Eigen::VectorXd>& directions) {
        Derivatives derivatives =
            EngineDerivatives(simulator, rollout, weights, directions);
        poison(&derivatives);
        return derivatives;
      });
}

TEST(StabilityCellTest, PoisonedDerivativesAreFoundOut) {
  EXPECT_EQ(RunPoisoned([](Derivatives*) {}).Text("gradient", ""), "right");
  const auto scale_both = [](Derivatives* d) {
    d->gradient *= 1.001;
    for (auto& tangent : d->tangents) tangent *= 1.001;
  };
  const Record both = RunPoisoned(scale_both);
  EXPECT_EQ(both.Text("gradient", ""), "wrong");
  EXPECT_THAT(both.Text("gradient_why", ""), HasSubstr("off differences by 0.001"));
  const Record adjoint = RunPoisoned([](Derivatives* d) { d->gradient[0] *= 1.01; });
  EXPECT_EQ(adjoint.Text("gradient", ""), "wrong");
  EXPECT_THAT(adjoint.Text("gradient_why", ""), HasSubstr("adjoint and tangent"));
  const Record vanished = RunPoisoned([](Derivatives* d) {
    d->gradient.setZero();
    for (auto& tangent : d->tangents) tangent.setZero();
  });
  EXPECT_EQ(vanished.Text("gradient", ""), "wrong");
  const Record silent = RunPoisoned([](Derivatives* d) {
    d->gradient.setConstant(std::numeric_limits<double>::quiet_NaN());
  });
  EXPECT_EQ(silent.Text("gradient", ""), "wrong");
  const Record refused = RunPoisoned([](Derivatives* d) { d->failure = "no way"; });
  EXPECT_EQ(refused.Text("gradient", ""), "refused");
  EXPECT_EQ(refused.Text("gradient_why", ""), "no way");
}

TEST(StabilityCellTest, AContactIsNoExcuseForAWrongDerivative) {
  const auto scale_both = [](Derivatives* d) {
    d->gradient *= 1.01;
    for (auto& tangent : d->tangents) tangent *= 1.01;
  };
  EXPECT_NE(RunPoisoned([](Derivatives*) {}, "sphere", 1e3).Text("gradient", ""),
            "wrong");
  EXPECT_EQ(RunPoisoned(scale_both, "sphere", 1e3).Text("gradient", ""), "wrong");
}

TEST(StabilityReportTest, CellsThatCrashOrTimeOutAreRowsAndNotTrusted) {
  std::vector<Row> rows = StabilityJobs("shift");
  const size_t cells = rows.size();
  ASSERT_EQ(cells, 16u);
  for (size_t i = 0; i < cells; ++i) {
    rows[i].Set("outcome", i == 1 ? "crashed" : i == 2 ? "timed_out" : "done");
    rows[i].Set("result", i == 3 ? "inaccurate" : "accurate");
    rows[i].Set("gradient", i == 4 ? "wrong" : "right");
  }
  EXPECT_EQ(ResultOf(rows[1]), "crashed");
  EXPECT_THAT(CountText(rows),
              HasSubstr("16 cells: 13 accurate, 1 crashed, 1 inaccurate, 1 timed_out"));
  const Results results = StabilityResults(rows);
  for (const Table& table : results.tables) {
    for (const auto& line : table.cells) {
      EXPECT_EQ(line.size(), table.columns.size()) << table.name;
    }
    if (table.name != "stability_trust") continue;
    for (const auto& line : table.cells) {
      if (line[0] != "shift of the origin (m)" || line[1] != "1000") continue;
      EXPECT_EQ(line[2], "tr_bdf2, 0 %");
      EXPECT_EQ(line[5], "1, 2");
    }
  }
}

TEST(StabilityJobsTest, AtLeast300CellsWithNamesOfTheirOwn) {
  const std::vector<Job> jobs = StabilityExperiment().jobs();
  EXPECT_GE(StabilityJobs().size(), 300u);
  std::set<std::string> names;
  for (const Job& job : jobs) names.insert(job.Text("id", ""));
  EXPECT_EQ(names.size(), jobs.size());
}

TEST(StabilityLongTest, WholeGridHasNoSilentCellAndNoWrongDerivative) {
  std::vector<Row> rows = StabilityJobs();
  ASSERT_GE(rows.size(), 300u);
  for (Row& row : rows) {
    const std::string id = row.Text("id", "");
    const Record result = StabilityJobKind().run(row);
    for (const auto& [key, value] : result.values()) row.Set(key, value);
    const std::string what = row.Text("result", "");
    EXPECT_NE(what, "silent") << id;
    EXPECT_NE(what, "refused") << id << ": " << row.Text("why", "");
    if (what == "failed") {
      EXPECT_GE(row.Integer("failed_frame", -1), 0) << id;
      // After "on the way to frame F, step S" comes a reason.
      EXPECT_THAT(row.Text("why", ""), HasSubstr(": ")) << id;
    }
    EXPECT_NE(row.Text("gradient", ""), "wrong")
        << id << ": " << row.Text("gradient_why", "");
    if (row.Text("gradient", "") == "not decidable") {
      EXPECT_FALSE(row.Text("gradient_why", "").empty()) << id;
    }
    EXPECT_NE(row.Text("agreement", ""), "disagrees") << id;
  }
  RecordProperty("counts", CountText(rows));
}

}  // namespace
}  // namespace dpe::experiments
