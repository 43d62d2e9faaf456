#include "experiments/tradeoff/simulation_results.h"

#include <algorithm>
#include <map>
#include <string>

#include "dpe/engine/quality.h"
#include "experiments/output/tables.h"
#include "experiments/tradeoff/candidate.h"
#include "experiments/tradeoff/rows.h"

namespace dpe::experiments::tradeoff {
namespace {

constexpr char kKind[] = "tradeoff_simulation";
constexpr int kNewtonLimit = 50;  // rows with another are about that limit alone

// The rows that are candidates for use.
std::vector<Row> Candidates(const std::vector<Row>& rows, const std::string& scene) {
  std::vector<Row> found;
  for (const Row& row : RowsOf(rows, kKind, scene)) {
    if (row.Integer("newton_iterations", kNewtonLimit) == kNewtonLimit) {
      found.push_back(row);
    }
  }
  return found;
}

std::string Millimetres(double metres) { return FormatNumber(1e3 * metres, 3); }
std::string Milliseconds(const Row& row) {
  return FormatNumber(1e3 * Measured(row, "frame_s"), 3);
}

std::string PresetName(const Row& row) {
  for (const QualityPreset& preset : QualityPresets()) {
    if (SettingsText(preset.simulation) == SettingsOf(row)) return preset.name;
  }
  return "";
}

Table ReferenceTable(const std::vector<Row>& rows) {
  Table table{"tradeoff_reference",
              "How far the reference may be trusted: the estimated error of TR-BDF2 "
              "with 128 steps per frame, before it is extrapolated. Errors of "
              "candidates near that mean nothing. Below it, for comparison, the errors "
              "of the two other references that suggest themselves.",
              {"scene", "motion", "RMS, 20 frames (mm)", "50 frames (mm)",
               "100 frames (mm)", "largest, 100 frames (mm)"},
              {}};
  const auto add = [&](const Row& row, const std::string& motion) {
    std::vector<std::string> cells = {row.Text("scene", ""), motion};
    for (const char* key : {"rms_20_m", "rms_50_m", "rms_100_m", "max_100_m"}) {
      cells.push_back(Millimetres(Measured(row, key)));
    }
    table.cells.push_back(cells);
  };
  for (const std::string& scene : TradeoffScenes()) {
    for (const Row& row : RowsOf(rows, "tradeoff_reference", scene)) {
      if (!row.Flag("uniform", false)) add(row, "uncertainty of the reference");
    }
    for (const Row& row : Candidates(rows, scene)) {
      if (row.Integer("steps", 0) == 64) add(row, SettingsOf(row));
    }
  }
  return table;
}

std::vector<std::string> FrontCells(const Row& row) {
  std::vector<std::string> cells = {row.Text("scene", ""), SettingsOf(row),
                                    PresetName(row), Milliseconds(row)};
  for (const char* key : {"rms_20_m", "rms_50_m", "rms_100_m", "max_100_m"}) {
    cells.push_back(Millimetres(Measured(row, key)));
  }
  cells.push_back(FormatNumber(Measured(row, "gradient_error"), 2));
  for (const char* key : {"forces", "assemblies", "factorisations", "solves"}) {
    cells.push_back(FormatNumber(Measured(row, key), 3));
  }
  cells.push_back(FormatNumber(Measured(row, "kept_mib"), 3));
  return cells;
}

const std::vector<std::string> kFrontColumns = {"scene",
                                                "settings",
                                                "preset",
                                                "ms per frame",
                                                "RMS, 20 frames (mm)",
                                                "50 frames (mm)",
                                                "100 frames (mm)",
                                                "largest (mm)",
                                                "gradient error",
                                                "forces",
                                                "assemblies",
                                                "factorisations",
                                                "solves",
                                                "kept for derivatives (MiB)"};

Table FrontTable(const std::vector<Row>& rows) {
  Table table{"tradeoff_front",
              "What no other candidate beats (cheaper and, over 100 frames, more "
              "accurate). Forces, assemblies, factorisations and solves are calls per "
              "frame. The gradient error is what the tolerances cost: the candidate's "
              "gradient of a functional of 20 frames, against that of the same steps "
              "solved to rounding level. What is kept is for the derivatives of 20 "
              "frames.",
              kFrontColumns,
              {}};
  for (const std::string& scene : TradeoffScenes()) {
    const std::vector<Row> candidates = Candidates(rows, scene);
    for (size_t i : ParetoFront(Points(candidates, "frame_s", "rms_100_m"))) {
      table.cells.push_back(FrontCells(candidates[i]));
    }
  }
  return table;
}

Table PresetTable(const std::vector<Row>& rows) {
  Table table{"tradeoff_presets",
              "What `--quality` costs and gives. Beaten by: a candidate that took less "
              "time in this measurement and is more accurate over 100 frames.",
              kFrontColumns,
              {}};
  table.columns.push_back("beaten by");
  for (const std::string& scene : TradeoffScenes()) {
    const std::vector<Row> candidates = Candidates(rows, scene);
    const std::vector<CostAndError> points = Points(candidates, "frame_s", "rms_100_m");
    for (const QualityPreset& preset : QualityPresets()) {
      for (size_t i = 0; i < candidates.size(); ++i) {
        if (PresetName(candidates[i]) != preset.name) continue;
        std::vector<std::string> cells = FrontCells(candidates[i]);
        cells.emplace_back();
        for (size_t j = 0; j < candidates.size(); ++j) {
          if (Beats(points[j], points[i])) cells.back() = SettingsOf(candidates[j]);
        }
        table.cells.push_back(cells);
        break;
      }
    }
  }
  return table;
}

// Settings with, for each, the largest error and the longest time over the scenes.
struct Overall {
  std::vector<std::string> settings;
  std::vector<CostAndError> points;
};

Overall OverAllScenes(const std::vector<Row>& rows, const std::string& error) {
  Overall overall;
  std::map<std::string, size_t> place;
  for (const std::string& scene : TradeoffScenes()) {
    for (const Row& row : Candidates(rows, scene)) {
      const std::string text = SettingsOf(row);
      const CostAndError point{Measured(row, "frame_s"), Measured(row, error)};
      const auto [found, is_new] = place.emplace(text, overall.points.size());
      if (is_new) {
        overall.settings.push_back(text);
        overall.points.push_back(point);
        continue;
      }
      CostAndError& worst = overall.points[found->second];
      // Not std::max: what is not a number in one scene is so for all.
      worst.cost = worst.cost >= point.cost ? worst.cost : point.cost;
      worst.error = worst.error >= point.error ? worst.error : point.error;
    }
  }
  return overall;
}

Table LiveWithTable(const std::vector<Row>& rows) {
  Table table{"tradeoff_live_with",
              "If you can live with an RMS error of so much, this is the cheapest that "
              "was found; it costs so much per frame. \"all\": in each of the scenes.",
              {"error (mm)", "scene", "20 frames: use", "ms per frame",
               "100 frames: use", "ms per frame (100)"},
              {}};
  for (double millimetres : {100.0, 30.0, 10.0, 3.0, 1.0, 0.3, 0.1, 0.01}) {
    std::vector<std::string> scenes = TradeoffScenes();
    scenes.push_back("all");
    for (const std::string& scene : scenes) {
      std::vector<std::string> cells = {FormatNumber(millimetres, 3), scene};
      for (const char* error : {"rms_20_m", "rms_100_m"}) {
        Overall choice;
        if (scene == "all") {
          choice = OverAllScenes(rows, error);
        } else {
          const std::vector<Row> candidates = Candidates(rows, scene);
          choice.points = Points(candidates, "frame_s", error);
          for (const Row& row : candidates) choice.settings.push_back(SettingsOf(row));
        }
        const size_t best = CheapestWithin(choice.points, 1e-3 * millimetres);
        const bool found = best < choice.points.size();
        cells.push_back(found ? choice.settings[best] : "none of the grid");
        cells.push_back(found ? FormatNumber(1e3 * choice.points[best].cost, 3) : "");
      }
      table.cells.push_back(cells);
    }
  }
  return table;
}

// What the tolerances do to motion and gradient, worst of the scenes.
Table ToleranceTable(const std::vector<Row>& rows) {
  Table table{"tradeoff_tolerances",
              "What a loose solve costs, worst of the three scenes: the error of the "
              "motion (100 frames), and that of the gradient. For the exact solves "
              "(cholesky, newton 1e-13) the gradient is compared with differences.",
              {"integrator", "solver", "tolerance", "newton", "steps", "RMS (mm)",
               "gradient error", "against differences"},
              {}};
  std::map<std::string, size_t> place;
  std::vector<std::vector<double>> worst;
  for (const std::string& scene : TradeoffScenes()) {
    for (const Row& row : Candidates(rows, scene)) {
      const Candidate candidate = CandidateFromRecord(row);
      if (!UsesLinearSolver(candidate.settings.method)) continue;
      const StepSettings& s = candidate.settings;
      const std::vector<double> values = {1e3 * Measured(row, "rms_100_m"),
                                          Measured(row, "gradient_error"),
                                          Measured(row, "difference_error")};
      const auto [found, is_new] = place.emplace(SettingsOf(row), worst.size());
      if (is_new) {
        worst.push_back(values);
        table.cells.push_back(
            {IntegrationMethodName(s.method), s.solver,
             s.solver == "cg" ? FormatNumber(s.tolerance) : "",
             UsesNewton(s.method) ? FormatNumber(s.newton_tolerance) : "",
             std::to_string(s.steps)});
      }
      for (size_t k = 0; k < values.size(); ++k) {
        double& value = worst[found->second][k];
        if (!(value >= values[k])) value = values[k];
      }
    }
  }
  for (size_t i = 0; i < worst.size(); ++i) {
    for (double value : worst[i]) table.cells[i].push_back(FormatNumber(value, 2));
  }
  return table;
}

Table FailureTable(const std::vector<Row>& rows) {
  Table table{"tradeoff_failures",
              "Simulations that stopped, and why.",
              {"scene", "settings", "Newton iterations at most", "why"},
              {}};
  for (const std::string& scene : TradeoffScenes()) {
    for (const Row& row : RowsOf(rows, kKind, scene)) {
      const std::string why = WhyNot(row);
      if (why.empty()) continue;
      table.cells.push_back(
          {scene, SettingsOf(row), FormatValue(row, "newton_iterations"), why});
    }
  }
  return table;
}

}  // namespace

void AddSimulationResults(const std::vector<Row>& rows, Results* results) {
  for (const std::string& scene : TradeoffScenes()) {
    const std::vector<Row> candidates = Candidates(rows, scene);
    for (int horizon : {20, 100}) {
      const std::string frames = std::to_string(horizon);
      Plot plot;
      plot.name = "tradeoff_" + scene + "_" + frames;
      plot.title = scene + ": error over " + frames + " frames against time";
      plot.x_label = "processor time (ms per frame of 20 ms)";
      plot.y_label = "RMS position error (mm)";
      plot.log_x = plot.log_y = true;
      plot.series = TradeoffSeries(
          candidates, Points(candidates, "frame_s", "rms_" + frames + "_m"), 1e3, 1e3,
          PresetName);
      results->plots.push_back(plot);
    }
  }
  for (Table (*make)(const std::vector<Row>&) :
       {ReferenceTable, PresetTable, LiveWithTable, FrontTable, ToleranceTable,
        FailureTable}) {
    results->tables.push_back(make(rows));
  }
}

}  // namespace dpe::experiments::tradeoff
