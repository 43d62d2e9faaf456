#include "experiments/tradeoff/fit_results.h"

#include <string>

#include "dpe/engine/quality.h"
#include "experiments/output/tables.h"
#include "experiments/tradeoff/candidate.h"
#include "experiments/tradeoff/rows.h"

namespace dpe::experiments::tradeoff {
namespace {

constexpr char kKind[] = "tradeoff_fit";

// What the fit was told beside its time stepping, in words; empty at the centre.
std::string Variation(const Row& row) {
  std::string text;
  const auto add = [&](const std::string& what) {
    text += (text.empty() ? "" : ", ") + what;
  };
  const std::string settings = row.Text("settings", "nR");
  if (settings != "nR") add(settings);
  if (row.Flag("uniform", false)) add("uniform cloth");
  const std::string estimate = row.Text("estimate", "");
  if (!estimate.empty()) add("with " + estimate);
  if (row.Text("fit_solver", "auto") != "auto") add(row.Text("fit_solver", ""));
  if (row.Text("init", "auto") != "auto") add("start " + row.Text("init", ""));
  if (row.Text("horizon", "auto") != "auto") add(row.Text("horizon", "") + " horizon");
  if (row.Integer("memory_limit_mib", -1) >= 0) add("keeps nothing");
  if (row.Has("max_iterations")) {
    add(std::to_string(row.Integer("max_iterations", 0)) + " iterations");
  }
  return text;
}

int CentreFrames(const std::string& scene) { return scene == "flag" ? 21 : 51; }

// Fits that differ in their time stepping alone.
std::vector<Row> Candidates(const std::vector<Row>& rows, const std::string& scene) {
  std::vector<Row> found;
  for (const Row& row : RowsOf(rows, kKind, scene)) {
    if (Variation(row).empty() && row.Integer("frames", 0) == CentreFrames(scene)) {
      found.push_back(row);
    }
  }
  return found;
}

// The presets fit with the solver that is taken by itself; that of the grid is the same
// for a cloth of this size.
std::string PresetName(const Row& row) {
  const StepSettings own = CandidateFromRecord(row).settings;
  for (const QualityPreset& preset : QualityPresets()) {
    if (preset.estimation.method == own.method &&
        preset.estimation.steps == own.steps && own.solver == "cholesky") {
      return preset.name;
    }
  }
  return "";
}

std::vector<std::string> Cells(const Row& row) {
  std::vector<std::string> cells = {row.Text("scene", ""),
                                    std::to_string(row.Integer("frames", 0) - 1),
                                    SettingsOf(row), Variation(row)};
  for (const char* key : {"bias_percent", "worst_percent"}) {
    cells.push_back(FormatNumber(Measured(row, key), 3));
  }
  cells.push_back(FormatNumber(1e3 * Measured(row, "residual_rms_m"), 3));
  for (const char* key : {"iterations", "rollouts", "passes", "total_steps", "fit_s"}) {
    cells.push_back(FormatNumber(Measured(row, key), 3));
  }
  cells.push_back(WhyNot(row));
  return cells;
}

const std::vector<std::string> kColumns = {
    "scene",     "frames",        "settings",   "what differs", "bias (%)",
    "worst (%)", "residual (mm)", "iterations", "rollouts",     "passes",
    "steps",     "fit (s)",       "why not"};

Table AllFits(const std::vector<Row>& rows) {
  Table table{"tradeoff_fits",
              "Fits to the reference motion, from which nothing but the time stepping "
              "of the fit differs: the mean deviation of the stiffnesses (or what else "
              "is fitted) from the true ones, and the largest. Passes are derivative "
              "passes, steps those of all rollouts.",
              kColumns,
              {}};
  for (const std::string& scene : TradeoffScenes()) {
    for (const Row& row : RowsOf(rows, kKind, scene)) table.cells.push_back(Cells(row));
  }
  return table;
}

Table FitPresets(const std::vector<Row>& rows) {
  Table table{"tradeoff_fit_presets",
              "What `estimate_cloth --quality` costs and gives. Beaten by: a candidate "
              "that took less time in this measurement and has less bias.",
              kColumns,
              {}};
  table.columns.back() = "beaten by";
  for (const std::string& scene : TradeoffScenes()) {
    const std::vector<Row> candidates = Candidates(rows, scene);
    const std::vector<CostAndError> points =
        Points(candidates, "fit_s", "bias_percent");
    for (size_t i = 0; i < candidates.size(); ++i) {
      const std::string name = PresetName(candidates[i]);
      if (name.empty()) continue;
      std::vector<std::string> cells = Cells(candidates[i]);
      cells[3] = name;
      cells.back().clear();
      for (size_t j = 0; j < candidates.size(); ++j) {
        if (Beats(points[j], points[i])) cells.back() = SettingsOf(candidates[j]);
      }
      table.cells.push_back(cells);
    }
  }
  table.columns[3] = "preset";
  return table;
}

Table FitLiveWith(const std::vector<Row>& rows) {
  Table table{"tradeoff_fit_live_with",
              "If you can live with stiffnesses that are off by so much (mean of the "
              "groups), this is the cheapest that was found; the fit costs so much.",
              {"bias (%)", "scene", "use", "fit (s)"},
              {}};
  for (double percent : {30.0, 10.0, 3.0, 1.0, 0.3, 0.1, 0.01}) {
    for (const std::string& scene : TradeoffScenes()) {
      const std::vector<Row> candidates = Candidates(rows, scene);
      const std::vector<CostAndError> points =
          Points(candidates, "fit_s", "bias_percent");
      const size_t best = CheapestWithin(points, percent);
      const bool found = best < points.size();
      table.cells.push_back({FormatNumber(percent, 3), scene,
                             found ? SettingsOf(candidates[best]) : "none of the grid",
                             found ? FormatNumber(points[best].cost, 3) : ""});
    }
  }
  return table;
}

}  // namespace

void AddFitResults(const std::vector<Row>& rows, Results* results) {
  for (const std::string& scene : TradeoffScenes()) {
    const std::vector<Row> candidates = Candidates(rows, scene);
    Plot plot;
    plot.name = "tradeoff_fit_" + scene;
    plot.title = scene + ": bias of fitted stiffnesses against time (" +
                 std::to_string(CentreFrames(scene) - 1) + " frames)";
    plot.x_label = "processor time of the fit (s)";
    plot.y_label = "mean deviation from the true stiffnesses (%)";
    plot.log_x = plot.log_y = true;
    plot.series = TradeoffSeries(
        candidates, Points(candidates, "fit_s", "bias_percent"), 1.0, 1.0, PresetName);
    results->plots.push_back(plot);
  }
  for (Table (*make)(const std::vector<Row>&) : {FitPresets, FitLiveWith, AllFits}) {
    results->tables.push_back(make(rows));
  }
}

}  // namespace dpe::experiments::tradeoff
