// Records as JSON, tables as text, scripts of plots, progress, Slurm's answers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "dpe/engine/scene.h"
#include "experiments/executors/progress.h"
#include "experiments/executors/shell.h"
#include "experiments/executors/slurm_commands.h"
#include "experiments/output/gnuplot.h"
#include "experiments/output/report.h"
#include "experiments/output/tables.h"
#include "experiments/record_io.h"
#include "support/temp_dir.h"

namespace dpe::test {
namespace {

using namespace dpe::experiments;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(RecordIoTest, WhatIsReadIsWhatWasWritten) {
  Record record;
  record.Set("huge", 1e308);
  record.Set("tiny", 5e-324);
  record.Set("third", 1.0 / 3.0);
  record.Set("whole double", 3.0);
  record.Set("count", std::numeric_limits<std::int64_t>::min());
  record.Set("yes", true);
  record.Set("text", "Überlänge \"λ\" \\ \n end");
  const Record read = RecordFromJson(RecordToJson(record), "here");
  EXPECT_EQ(read.values(), record.values());
}

TEST(RecordIoTest, WhatIsNotFiniteIsNull) {
  Record record;
  record.Set("nan", std::nan(""));
  record.Set("inf", std::numeric_limits<double>::infinity());
  const std::string text = RecordToJson(record);
  EXPECT_EQ(text, "{\"nan\":null,\"inf\":null}");
  EXPECT_TRUE(std::isnan(RecordFromJson(text, "here").Number("nan", 0.0)));
}

TEST(RecordIoTest, BytesThatAreNotUtf8DoNotStopIt) {
  Record record;
  record.Set("reason", "bad \xff byte");
  EXPECT_THAT(RecordFromJson(RecordToJson(record), "here").Text("reason", ""),
              AllOf(HasSubstr("bad"), HasSubstr("byte")));
}

TEST(RecordIoTest, NumbersBeyondDoublesAndWholeNumbersAreRefused) {
  EXPECT_THROW(RecordFromJson("{\"a\":1e400}", "f:1"), SceneError);
  EXPECT_THROW(RecordFromJson("{\"a\":18446744073709551615}", "f:1"), SceneError);
}

TEST(TablesTest, CsvQuotesWhatWouldBreakIt) {
  Table table;
  table.columns = {"a", "b"};
  table.cells = {{"1,2", "say \"x\""}, {"two\nlines", "plain"}};
  EXPECT_EQ(TableToCsv(table),
            "a,b\n\"1,2\",\"say \"\"x\"\"\"\n\"two\nlines\",plain\n");
}

TEST(TablesTest, MarkdownEscapesPipesAndAlignsNumbers) {
  Table table;
  table.caption = "What it is.";
  table.columns = {"name", "value"};
  table.cells = {{"a|b", "1.5"}, {"c\nd", ""}};
  EXPECT_EQ(TableToMarkdown(table),
            "What it is.\n\n| name | value |\n|---|---:|\n| a\\|b | 1.5 |\n| c<br>d |  "
            "|\n");
}

TEST(TablesTest, RowsOfDifferentKeysMakeOneTable) {
  Record first, second;
  first.Set("id", "a");
  first.Set("outcome", "failed");
  second.Set("id", "b");
  second.Set("outcome", "done");
  second.Set("rms_m", 0.1);
  const Table table = TableOfRows("t", {first, second});
  EXPECT_EQ(table.columns, (std::vector<std::string>{"id", "rms_m", "outcome"}));
  EXPECT_EQ(table.cells[0], (std::vector<std::string>{"a", "", "failed"}));
  EXPECT_EQ(table.cells[1], (std::vector<std::string>{"b", "0.1", "done"}));
}

TEST(TablesTest, AllDigitsAreTheShortestThatReadBack) {
  EXPECT_EQ(FormatNumber(0.1, 17), "0.1");
  EXPECT_EQ(FormatNumber(10.0, 17), "10");
  EXPECT_EQ(std::stod(FormatNumber(1.0 / 3.0, 17)), 1.0 / 3.0);
  EXPECT_EQ(FormatNumber(1.23456e-12, 3), "1.23e-12");
  EXPECT_EQ(FormatNumber(std::nan(""), 3), "");
}

Plot TwoSeries() {
  Plot plot;
  plot.name = "plot";
  plot.title = "It's \"quoted\" with_underscore";
  plot.x_label = "time (s)";
  plot.y_label = "error (m)";
  plot.log_y = true;
  plot.series.push_back({"curve", true, true, {1, 2, 3}, {1e-3, 0.0, 1e-9}, {}});
  plot.series.push_back({"nothing", false, true, {1}, {std::nan("")}, {}});
  return plot;
}

TEST(GnuplotTest, LeavesOutWhatCannotBeDrawn) {
  const std::string script = GnuplotScript(TwoSeries(), "plot.svg");
  EXPECT_THAT(script, AllOf(HasSubstr("1 0.001 "), HasSubstr("3 1e-09 ")));
  EXPECT_THAT(script, Not(HasSubstr("2 0 ")));
  EXPECT_THAT(script, Not(HasSubstr("nothing")));
  EXPECT_THAT(script, HasSubstr("set logscale y"));
  Plot empty = TwoSeries();
  empty.series.erase(empty.series.begin());
  EXPECT_EQ(GnuplotScript(empty, "plot.svg"), "");
}

TEST(GnuplotTest, StylesAndNamesOfTheAxisAreTaken) {
  Plot plot = TwoSeries();
  const std::string without = GnuplotScript(plot, "plot.svg");
  EXPECT_EQ(without.find("ytics"), std::string::npos);
  EXPECT_EQ(without.find("#8c6d31"), std::string::npos);
  plot.series[0].style = 7;
  plot.y_names = {{1.0, "one \"a\""}, {2.5, "b"}};
  const std::string script = GnuplotScript(plot, "plot.svg");
  EXPECT_NE(script.find("set ytics noenhanced (\"one \\\"a\\\"\" 1, \"b\" 2.5)"),
            std::string::npos)
      << script;
  EXPECT_NE(script.find("#8c6d31"), std::string::npos);
}

TEST(GnuplotTest, DrawsAnSvgWithTitleAndAxes) {
  if (RunCommand({"gnuplot", "--version"}).exit_code != 0) {
    GTEST_SKIP() << "gnuplot is not installed";
  }
  const TempDir folder;
  ASSERT_EQ(DrawPlot(TwoSeries(), folder.path()), "");
  const std::string svg = ReadFile(folder.File("plot.svg"));
  EXPECT_THAT(svg,
              AllOf(HasSubstr("<svg"), HasSubstr("time (s)"), HasSubstr("error (m)"),
                    HasSubstr("with_underscore"), HasSubstr("curve")));
}

TEST(ShellTest, ReadsBothStreamsHoweverMuchTheyHold) {
  const CommandResult result = RunCommand(
      {"sh", "-c", "head -c 300000 /dev/zero; head -c 200000 /dev/zero >&2; exit 5"});
  EXPECT_EQ(result.exit_code, 5);
  EXPECT_EQ(result.out.size(), 300000u);
  EXPECT_EQ(result.err.size(), 200000u);
  EXPECT_EQ(RunCommand({"there-is-no-such-program"}).exit_code, 127);
}

TEST(ProgressTest, SaysWhatIsLeft) {
  Progress progress(40, 10);
  EXPECT_EQ(progress.Line(2, 5.0), "10 of 40 jobs; 2 running");
  for (int i = 0; i < 9; ++i) progress.JobEnded("done");
  progress.JobEnded("crashed");
  EXPECT_EQ(progress.Line(2, 100.0),
            "20 of 40 jobs, 1 crashed; 2 running; about 3 min left");
  EXPECT_EQ(DurationText(45), "45 s");
  EXPECT_EQ(DurationText(2 * 3600 + 600), "2 h 10 min");
}

TEST(SlurmCommandsTest, ReadsTheQueueOfOneCampaign) {
  const auto tasks = ParseQueue(
      "17|3|RUNNING|dpe_ab_0\n17|4|PENDING|dpe_ab_0\n18|0|RUNNING|other\n"
      "19|N/A|RUNNING|dpe_ab_1\nslurm_load_jobs error\n",
      "dpe_ab_");
  ASSERT_EQ(tasks.size(), 2u);
  EXPECT_EQ(tasks[0].array, "17");
  EXPECT_EQ(tasks[0].index, 3);
  EXPECT_TRUE(tasks[0].is_running);
  EXPECT_FALSE(tasks[1].is_running);
  EXPECT_EQ(tasks[1].name, "dpe_ab_0");
}

}  // namespace
}  // namespace dpe::test
