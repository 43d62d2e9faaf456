// The trade-off experiment: its parts, and that the presets of --quality are on the
// front of what was measured, by counts of what rollouts consist of.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "dpe/engine/quality.h"
#include "dpe/engine/scene_io.h"
#include "experiments/tradeoff/candidate.h"
#include "experiments/tradeoff/front.h"
#include "experiments/tradeoff/grid.h"
#include "experiments/tradeoff/jobs.h"
#include "experiments/tradeoff/measures.h"
#include "experiments/tradeoff/reference.h"
#include "experiments/tradeoff/work.h"

namespace dpe::experiments::tradeoff {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
// Errors that differ by less than this fraction are the same for any purpose.
constexpr double kSameError = 0.05;

TEST(TradeoffFrontTest, IsWhatNothingBeats) {
  const std::vector<CostAndError> points = {{1.0, 9.0},  {2.0, 3.0},  {3.0, 3.0},
                                            {0.5, 10.0}, {4.0, kNan}, {kNan, 0.0},
                                            {5.0, 1.0},  {6.0, 2.0}};
  EXPECT_EQ(ParetoFront(points), (std::vector<size_t>{3, 0, 1, 6}));
  EXPECT_EQ(CheapestWithin(points, 3.0), 1u);
  EXPECT_EQ(CheapestWithin(points, 0.5), points.size());
  EXPECT_TRUE(Beats(points[0], points[4]));
  EXPECT_FALSE(Beats(points[4], points[7]));
  EXPECT_FALSE(Beats(points[1], points[2]));  // as accurate, not more
}

TEST(TradeoffGridTest, CoversWhatItSaysAndThePresets) {
  std::set<std::string> grid;
  for (const StepSettings& settings : SimulationGrid()) {
    EXPECT_TRUE(grid.insert(SettingsText(settings)).second) << SettingsText(settings);
  }
  for (const QualityPreset& preset : QualityPresets()) {
    EXPECT_EQ(grid.count(SettingsText(preset.simulation)), 1u) << preset.name;
  }
  std::set<std::string> ids;
  for (const Job& job : TradeoffJobs()) {
    const std::string id = job.Text("id", "");
    EXPECT_TRUE(ids.insert(id).second) << id;
  }
  EXPECT_GT(ids.size(), 400u);
}

TEST(TradeoffSceneTest, IsTheSceneOfTheDataFolder) {
  for (const std::string name : {"side", "corners", "flag"}) {
    Candidate candidate;
    candidate.scene = name;
    const Scene made = CandidateScene(candidate);
    const Scene file = LoadScene(DPE_SOURCE_DIR "/data/" + name + ".txt");
    EXPECT_EQ(made.objects[0].positions, file.objects[0].positions);
    EXPECT_EQ(made.objects[0].stiffness, file.objects[0].stiffness);
    EXPECT_EQ(made.wind, file.wind);
    EXPECT_EQ(made.delta, file.delta);
    const std::vector<int>& groups = made.objects[0].spring_group;
    EXPECT_EQ(std::set<int>(groups.begin(), groups.end()).size(), 4u);
  }
}

Candidate SmallCandidate(const std::string& scene, const StepSettings& settings) {
  Candidate candidate;
  candidate.scene = scene;
  candidate.resolution = 6;
  candidate.frames = 21;
  candidate.settings = settings;
  return candidate;
}

// Of a second-order method with a quarter of the step the error is a sixteenth; the
// reference is far better than both.
TEST(TradeoffReferenceTest, IsWhatTheSecondOrderMethodConvergesTo) {
  const auto error = [](int steps) {
    const Candidate candidate =
        SmallCandidate("side", {IntegrationMethod::kTrBdf2, steps, "cholesky"});
    Record job;
    SetCandidate(candidate, &job);
    return RunSimulationJob(job).Number("rms_20_m", kNan);
  };
  const double coarse = error(4), fine = error(16);
  EXPECT_NEAR(std::log2(coarse / fine) / 2.0, 2.0, 0.1);
  Record job;
  SetCandidate(SmallCandidate("side", {}), &job);
  EXPECT_LT(RunReferenceJob(job).Number("rms_20_m", kNan), 0.1 * fine);
}

TEST(TradeoffJobTest, TellsAnUnstableMethodByNameAndALooseGradientByItsError) {
  Record job;
  SetCandidate(SmallCandidate("side", {IntegrationMethod::kExplicitEuler, 1}), &job);
  job.Set("resolution", 12);
  const Record unstable = RunSimulationJob(job);
  EXPECT_NE(unstable.Text("stopped", "").find("range of finite numbers"),
            std::string::npos);
  EXPECT_TRUE(std::isnan(unstable.Number("gradient_error", 0.0)));
  const auto gradient_error = [](double tolerance) {
    Record loose;
    SetCandidate(
        SmallCandidate("side", {IntegrationMethod::kTrBdf2, 2, "cg", tolerance, 1e-13}),
        &loose);
    loose.Set("difference", true);
    const Record row = RunSimulationJob(loose);
    EXPECT_LT(row.Number("difference_error", kNan), 1e-6);
    return row.Number("gradient_error", kNan);
  };
  const double at_2 = gradient_error(1e-2), at_8 = gradient_error(1e-8);
  EXPECT_LT(at_8, 1e-6);
  EXPECT_GT(at_2, 100.0 * at_8);
}

TEST(TradeoffJobTest, TheBiasOfAFitFallsWithTheSquareOfTheStep) {
  const auto bias = [](int steps) {
    Record job;
    SetCandidate(
        SmallCandidate("side", {IntegrationMethod::kTrBdf2, steps, "cholesky"}), &job);
    job.Set("settings", "nR");
    const Record row = RunFitJob(job);
    EXPECT_EQ(row.Text("stopped", "?"), "");
    EXPECT_EQ(row.Integer("parameters", 0), 4);
    return row.Number("bias_percent", kNan);
  };
  const double coarse = bias(2), fine = bias(8);
  EXPECT_GT(coarse, 1e-3);
  EXPECT_NEAR(std::log2(coarse / fine) / 2.0, 2.0, 0.3);
}

// The rows of a grid, without times and gradients.
std::vector<Record> Rows(const std::string& scene, int resolution, int frames) {
  std::vector<Record> rows;
  for (const StepSettings& settings : SimulationGrid()) {
    Candidate candidate;
    candidate.scene = scene;
    candidate.resolution = resolution;
    candidate.frames = frames;
    candidate.settings = settings;
    rows.emplace_back();
    SetCandidate(candidate, &rows.back());
    const Scene made = CandidateScene(candidate);
    Timings timings;
    SimulatorOptions options = CandidateOptions(candidate);
    options.timings = &timings;
    const Trajectory trajectory = Simulator(made, options).Simulate(frames);
    if (!trajectory.status.ok()) continue;
    SetWork(timings, frames, &rows.back());
    const Eigen::MatrixXd difference =
        trajectory.positions[0] - CachedReference(made, frames).positions;
    rows.back().Set("error", ErrorOver(difference, made, frames - 1).rms);
  }
  return rows;
}

// No candidate is cheaper than a preset and more accurate, whichever of the weights is
// off by a quarter.
void ExpectPresetsOnFront(const std::string& scene, int resolution, int frames) {
  const std::vector<Record> rows = Rows(scene, resolution, frames);
  std::vector<WorkWeights> all_weights(1);
  for (double WorkWeights::*weight :
       {&WorkWeights::assembly, &WorkWeights::factorisation, &WorkWeights::solve,
        &WorkWeights::krylov_solve}) {
    for (double factor : {0.8, 1.25}) {
      all_weights.emplace_back();
      all_weights.back().*weight *= factor;
    }
  }
  for (const QualityPreset& preset : QualityPresets()) {
    const std::string own = SettingsText(preset.simulation);
    for (const WorkWeights& weights : all_weights) {
      CostAndError of_preset{kNan, kNan};
      for (const Record& row : rows) {
        if (SettingsText(CandidateFromRecord(row).settings) == own) {
          of_preset = {Work(row, weights), row.Number("error", kNan)};
        }
      }
      ASSERT_TRUE(std::isfinite(of_preset.cost * of_preset.error)) << own;
      of_preset.error *= 1.0 - kSameError;
      for (const Record& row : rows) {
        const CostAndError other{Work(row, weights), row.Number("error", kNan)};
        EXPECT_FALSE(Beats(other, of_preset))
            << scene << ": " << preset.name << " (" << own << ", work "
            << of_preset.cost << ", " << of_preset.error << " m) is beaten by "
            << SettingsText(CandidateFromRecord(row).settings) << " (" << other.cost
            << ", " << other.error << " m)";
      }
    }
  }
}

TEST(TradeoffPresetsTest, AreOnTheFrontOfASmallCloth) {
  ExpectPresetsOnFront("side", 6, 11);
  ExpectPresetsOnFront("flag", 6, 11);
}

TEST(TradeoffPresetsLongTest, AreOnTheFrontOfEveryScene) {
  for (const char* scene : {"side", "corners", "flag"}) {
    ExpectPresetsOnFront(scene, 12, 101);
  }
}

}  // namespace
}  // namespace dpe::experiments::tradeoff
