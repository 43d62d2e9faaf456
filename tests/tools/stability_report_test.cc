// What the report of the stability experiment advises, and what it must not.
#include "experiments/stability/stability_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "experiments/stability/stability.h"
#include "experiments/stability/stability_advice.h"
#include "experiments/stability/stability_plots.h"

namespace dpe::experiments {
namespace {

using testing::HasSubstr;
using testing::Not;

// Rows of one axis, all of them accurate.
std::vector<Row> AccurateRows(const std::string& axis) {
  std::vector<Row> rows = StabilityJobs(axis);
  for (Row& row : rows) {
    row.Set("outcome", "done");
    row.Set("result", "accurate");
    row.Set("gradient", "right");
    row.Set("error", 0.01);
  }
  return rows;
}

void Fail(const std::string& why, Row* row) {
  row->Set("result", "failed");
  row->Set("gradient", "");
  row->Set("why",
           "the simulation left the range of finite numbers in object 0 on the "
           "way to frame 3, step 0: " +
               why);
}

// The line of an axis, as one text per column.
std::vector<std::string> LineOf(const Table& table, const std::string& axis) {
  for (const auto& line : table.cells) {
    if (line[0].find(axis) == 0) return line;
  }
  return {};
}

TEST(StabilityAdviceTest, RangesEndAtTestedValuesAndShareNone) {
  std::vector<Row> rows = AccurateRows("drag");  // 0, 1, 10, 100
  for (Row& row : rows) {
    if (row.Number("value", 0.0) < 10.0 || row.Integer("integrator", 0) > 1) continue;
    Fail("symplectic_euler is unstable for steps h longer than 2 / w", &row);
  }
  const auto line = LineOf(AdviceTable(rows), "drag");
  ASSERT_EQ(line.size(), 3u);
  EXPECT_EQ(line[1], "0 ... 1: symplectic_euler; 10 ... 100: linearly_implicit_euler");
  EXPECT_EQ(
      line[2],
      "explicit_euler, symplectic_euler at 10, 100: the simulation left the range "
      "of finite numbers: steps too long");
}

TEST(StabilityAdviceTest, WhereNothingIsAccurateItSaysWhatIsLeastOff) {
  std::vector<Row> rows = AccurateRows("drag");
  for (Row& row : rows) {
    row.Set("result", "inaccurate");
    row.Set("error", row.Integer("integrator", 0) == 3 ? 0.2 : 0.3);
  }
  EXPECT_EQ(LineOf(AdviceTable(rows), "drag")[1],
            "0 ... 100: shorter steps (least off: implicit_euler)");
  EXPECT_THAT(LineOf(TrustTable(rows), "drag")[2], HasSubstr("implicit_euler), 20 %"));
}

TEST(StabilityAdviceTest, AMethodThatIsBarelyAccurateIsNamedSo) {
  std::vector<Row> rows = AccurateRows("drag");
  for (Row& row : rows) {
    if (row.Number("value", 0.0) == 100.0) row.Set("error", 0.046);
  }
  EXPECT_EQ(LineOf(AdviceTable(rows), "drag")[1],
            "0 ... 10: symplectic_euler; 100: symplectic_euler, barely");
}

// A method that happens to step over the place is no advice.
TEST(StabilityAdviceTest, WhereSpringEndsMeetNothingIsToBeTrusted) {
  std::vector<Row> rows = AccurateRows("coincident");  // 0, 1e-9, 1e-3
  for (Row& row : rows) {
    if (row.Number("value", 1.0) != 0.0 || row.Integer("integrator", 0) == 4) continue;
    Fail("the ends of spring 0 are in the same place", &row);
  }
  const auto line = LineOf(AdviceTable(rows), "least distance of two");
  ASSERT_EQ(line.size(), 3u);
  EXPECT_THAT(line[1], testing::StartsWith("0: none"));
  EXPECT_THAT(line[1], Not(HasSubstr("tr_bdf2")));
  EXPECT_THAT(line[1], HasSubstr("1e-09 ... 0.001: symplectic_euler"));
  EXPECT_THAT(line[2],
              HasSubstr("finite numbers: the ends of a spring are in the same place"));
}

TEST(StabilityAdviceTest, AWrongGradientIsNotTrusted) {
  for (const char* verdict : {"wrong", "refused"}) {
    std::vector<Row> rows = AccurateRows("drag");
    for (Row& row : rows) {
      if (row.Integer("integrator", 0) == 1) row.Set("gradient", verdict);
    }
    EXPECT_EQ(LineOf(AdviceTable(rows), "drag")[1],
              "0 ... 100: linearly_implicit_euler");
  }
}

TEST(StabilityReportTest, SaysWhereTheKrylovSolverDiffers) {
  std::vector<Row> rows = AccurateRows("drag");
  EXPECT_THAT(StabilityResults(rows).tables[0].caption, HasSubstr("12 of 12 cells."));
  for (Row& row : rows) {
    if (row.Text("solver", "") == "cg" && row.Integer("integrator", 0) == 3 &&
        row.Number("value", 0.0) == 10.0) {
      row.Set("result", "inaccurate");
    }
  }
  EXPECT_THAT(
      StabilityResults(rows).tables[0].caption,
      HasSubstr("11 of 12 cells, but not: implicit_euler at drag coefficient 10"));
}

TEST(StabilityPlotsTest, EachPlotIsDrawnOnce) {
  std::set<std::string> names;
  for (const Plot& plot : StabilityPlots({})) {
    EXPECT_TRUE(names.insert(plot.name).second) << plot.name;
  }
  EXPECT_EQ(names.count("stability_energy"), 1u);
}

TEST(StabilityPlotsTest, EnergyIsPlottedAsWhatItIsOffBy) {
  Row row;
  row.Set("kind", "energy");
  row.Set("integrator", 1);
  row.Set("time", "0 1 2");
  row.Set("energy", "1 1.25 0.5");
  for (const Plot& plot : StabilityPlots({row})) {
    if (plot.name != "stability_energy") continue;
    EXPECT_TRUE(plot.log_y);
    EXPECT_EQ(plot.x_label, "time (s)");
    ASSERT_EQ(plot.series.size(), 1u);
    ASSERT_EQ(plot.series[0].y.size(), 3u);
    EXPECT_EQ(plot.series[0].y[0], 0.0);  // is left out on a logarithmic axis
    EXPECT_EQ(plot.series[0].y[1], 0.25);
    EXPECT_EQ(plot.series[0].y[2], 0.5);
    return;
  }
  FAIL() << "there is no plot of energy";
}

}  // namespace
}  // namespace dpe::experiments
