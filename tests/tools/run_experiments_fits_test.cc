// The kinds of jobs "estimate" and "floor", and the experiments made of them.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "dpe/engine/scene.h"
#include "experiments/campaign.h"
#include "experiments/fits/estimate.h"
#include "experiments/fits/experiment1.h"
#include "experiments/fits/experiment2.h"
#include "experiments/fits/floor.h"
#include "experiments/fits/minimize.h"
#include "experiments/fits/predecessor.h"
#include "tools/run_experiments_support.h"

namespace dpe::test {
namespace {

using namespace dpe::experiments;
using ::testing::HasSubstr;

double Rosenbrock(const std::vector<double>& p) {
  const double a = 1.0 - p[0], b = p[1] - p[0] * p[0];
  return 0.5 + a * a + 10.0 * b * b;
}

TEST(MinimizeTest, FindsTheLowestOfSeveralMinima) {
  const Objective wells = [](const std::vector<double>& p) {
    return std::cos(6.0 * p[0]) + 0.1 * (p[0] - 1.4) * (p[0] - 1.4);
  };
  const auto minima = GridMinima(wells, {-3.0}, {3.0}, {61}, 4);
  ASSERT_EQ(minima.size(), 4u);
  const Minimum best =
      GoldenSection(wells, minima[0].at[0] - 0.1, minima[0].at[0] + 0.1, 1e-9);
  // The derivative there: -6 sin 6x + 0.2 (x - 1.4) = 0.
  EXPECT_NEAR(-6.0 * std::sin(6.0 * best.at[0]) + 0.2 * (best.at[0] - 1.4), 0.0, 1e-6);
  EXPECT_NEAR(best.at[0], 1.5708, 0.01);
  for (const Minimum& other : minima) EXPECT_LE(best.value, other.value);
}

TEST(MinimizeTest, NelderMeadFollowsACurvedValley) {
  const Minimum best = NelderMead(Rosenbrock, {-1.0, 2.0}, 0.3, 1e-12);
  EXPECT_NEAR(best.at[0], 1.0, 1e-4);
  EXPECT_NEAR(best.at[1], 1.0, 1e-4);
  EXPECT_NEAR(best.value, 0.5, 1e-9);
}

TEST(MinimizeTest, PointsThatCannotBeEvaluatedAreNoMinima) {
  const Objective half = [](const std::vector<double>& p) {
    return p[0] < 0.0 ? std::numeric_limits<double>::infinity() : p[0] + p[1] * p[1];
  };
  const auto minima = GridMinima(half, {-1.0, -1.0}, {1.0, 1.0}, {5, 5}, 10);
  ASSERT_EQ(minima.size(), 1u);
  EXPECT_EQ(minima[0].at, (std::vector<double>{0.0, 0.0}));
}

Job SmallFit(const std::string& kind, const std::string& settings) {
  Job job;
  job.Set("id", "a");
  job.Set("kind", Record::Value(kind));
  job.Set("preset", "side");
  job.Set("grid", 5);
  job.Set("frames", 20);
  job.Set("settings", Record::Value(settings));
  return job;
}

// One search knows nothing of the other.
TEST(FloorKindTest, IsWhatFitsReach) {
  for (const std::string settings : {"nG", "Gn", "GG"}) {
    const double floor =
        FloorKind().run(SmallFit("floor", settings)).Number("floor_m", -1.0);
    const Record fit = EstimateKind().run(SmallFit("estimate", settings));
    EXPECT_GT(floor, 1e-4) << settings;
    EXPECT_NEAR(fit.Number("rms_m", -1.0), floor, 1e-6 * floor) << settings;
  }
  EXPECT_THROW(FloorKind().run(SmallFit("floor", "nL")), SceneError);
}

TEST(EstimateKindTest, ReportsWhatTheFitReached) {
  Job job = SmallFit("estimate", "nL");
  job.Set("validate_frames", 60);
  const Record row = EstimateKind().run(job);
  EXPECT_LT(row.Number("rms_m", 1.0), 1e-12);
  EXPECT_LT(row.Number("validation_rms_m", 1.0), 1e-9);
  EXPECT_LT(row.Number("deviation_percent", 1.0), 1e-6);
  EXPECT_EQ(row.Text("termination", ""), "converged");
  EXPECT_EQ(row.Text("start", ""), "inverse_dynamics");
  EXPECT_GT(row.Integer("parameters", 0), 50);
  EXPECT_GT(row.Number("fit_s", 0.0), 0.0);
}

TEST(EstimateKindTest, ReportsSingleValuesAndErrorBars) {
  Job job = SmallFit("estimate", "nG");
  job.Set("uncertainty", "on");
  job.Set("noise_sigma", 0.001);
  job.Set("init", "uniform:5");
  job.Set("horizon", "full");
  const Record row = EstimateKind().run(job);
  EXPECT_GT(row.Number("value_0_stiffness", 0.0), 1.0);
  EXPECT_EQ(row.Text("start", ""), "uniform");
  EXPECT_THAT(row.Text("determined", ""), HasSubstr("the parameter was determined"));
}

TEST(EstimateKindTest, RefusesArgumentsNamingThem) {
  const auto error_of = [](const std::string& key, const Record::Value& value) {
    Job job = SmallFit("estimate", "nG");
    job.Set(key, value);
    try {
      EstimateKind().run(job);
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(error_of("iterations", std::int64_t{3}),
              HasSubstr("iterations: there is"));
  EXPECT_THAT(error_of("init", std::string("far")), HasSubstr("init: \"far\""));
  EXPECT_THAT(error_of("solver", std::string("gd")), HasSubstr("solver: \"gd\""));
  EXPECT_THAT(error_of("frames", 2.5), HasSubstr("frames: 2.5"));
  EXPECT_THAT(error_of("noise_sigma", -1.0), HasSubstr("noise_sigma: -1"));
  EXPECT_THAT(error_of("scene", std::string("x.txt")),
              HasSubstr("expected one of them"));
  EXPECT_EQ(error_of("note_why", std::string("mine")), "");
}

TEST(ExperimentsTest, JobsAreValidAndResultsCopeWithRowsThatFailed) {
  for (const Experiment& experiment : {Experiment1(), Experiment2()}) {
    const std::vector<Job> jobs = experiment.jobs();
    EXPECT_NO_THROW(RequireValidJobs(jobs, experiment.name));
    std::vector<Row> rows;
    for (const Job& job : jobs) {
      rows.push_back(job);
      rows.back().Set("outcome", "crashed");
    }
    const Results results = experiment.results(rows);
    ASSERT_EQ(results.tables.size(), 1u);
    for (const auto& cells : results.tables[0].cells) {
      EXPECT_EQ(cells.size(), results.tables[0].columns.size());
      EXPECT_THAT(cells, ::testing::Contains("crashed"));
    }
  }
  EXPECT_EQ(Experiment2().jobs().size(), 40u);
  EXPECT_EQ(PredecessorFits().size(), 16u);
}

// The floor's row stands beside that of the fit.
TEST(ExperimentsTest, TheTableOfExperiment1HasFloorAndPredecessor) {
  std::vector<Row> rows;
  for (const Job& job : Experiment1().jobs()) {
    const std::string id = job.Text("id", "");
    if (id != "side-100_nG_default" && id != "floor_side-100_nG") continue;
    rows.push_back(job);
    rows.back().Set("outcome", "done");
    if (id[0] == 'f') {
      rows.back().Set("floor_m", 0.04);
    } else {
      rows.back().Set("rms_m", 0.05);
    }
  }
  ASSERT_EQ(rows.size(), 2u);
  const Table table = Experiment1().results(rows).tables[0];
  ASSERT_EQ(table.cells.size(), 1u);
  EXPECT_EQ(table.cells[0][5], "0.04");
  EXPECT_EQ(table.cells[0][6], "1.25");
  EXPECT_EQ(table.cells[0][14], "0.0415");
}

}  // namespace
}  // namespace dpe::test
