#include "experiments/stability/stability_report.h"

#include <map>
#include <utility>

#include "experiments/output/tables.h"
#include "experiments/stability/stability_advice.h"
#include "experiments/stability/stability_cells.h"
#include "experiments/stability/stability_plots.h"
#include "experiments/stability/stability_scene.h"

namespace dpe::experiments {
namespace {

std::string CellText(const Row* row) {
  if (row == nullptr) return "-";
  const std::string result = ResultOf(*row);
  const double error = 100.0 * row->Number("error", 0.0);
  std::string text = result;
  if (result == "accurate" || result == "inaccurate") {
    text += " " + FormatNumber(error, 2) + " %";
  } else if (result == "failed" && row->Has("failed_frame")) {
    text += " at frame " + std::to_string(row->Integer("failed_frame", -1));
  }
  const std::string gradient = row->Text("gradient", "");
  if (!gradient.empty() && gradient != "right") text += ", gradient " + gradient;
  return text;
}

// Every value of every axis by every way.
Table ValueTable(const std::vector<Row>& rows) {
  Table table;
  table.name = "stability_values";
  table.caption =
      "Every cell. Per cent: the error, of the size of the motion; accurate is up to 5 "
      "%. Gradients are right where nothing else is said.";
  table.columns = {"axis", "value"};
  for (const Way& way : kWays) table.columns.push_back(WayName(way));
  for (const StabilityAxis& axis : StabilityAxes()) {
    const Cells cells(rows, axis.name);
    for (double value : axis.values) {
      std::vector<std::string> line = {axis.label, ValueText(value)};
      for (const Way& way : kWays) line.push_back(CellText(cells.Find(value, way)));
      table.cells.push_back(std::move(line));
    }
  }
  return table;
}

std::string RangeText(double first, double last, const std::string& result) {
  if (first == last) return ValueText(first) + ": " + result;
  return ValueText(first) + " ... " + ValueText(last) + ": " + result;
}

// Neighbouring values with the same result as one range.
std::string Ranges(const Cells& cells, const std::vector<double>& values,
                   const Way& way) {
  std::string text, current;
  size_t begin = 0;
  const auto flush = [&](size_t end) {
    if (current.empty()) return;
    if (!text.empty()) text += "; ";
    text += begin == 0 && end == values.size()
                ? "all: " + current
                : RangeText(values[begin], values[end - 1], current);
  };
  for (size_t i = 0; i < values.size(); ++i) {
    const Row* row = cells.Find(values[i], way);
    const std::string result = row == nullptr ? "-" : ResultOf(*row);
    if (result == current) continue;
    flush(i);
    begin = i;
    current = result;
  }
  flush(values.size());
  return text;
}

Table RangeTable(const std::vector<Row>& rows) {
  Table table;
  table.name = "stability_ranges";
  table.caption =
      "From where to where each method is accurate (within 5 % of the motion), "
      "inaccurate (stable, but further off) or fails, with the direct solver. Steps "
      "are 2 ms unless the axis says otherwise.";
  table.columns = {"axis"};
  for (const Way& way : kWays) {
    if (way.is_direct()) {
      table.columns.push_back(MethodName(way.method));
    }
  }
  for (const StabilityAxis& axis : StabilityAxes()) {
    const Cells cells(rows, axis.name);
    std::vector<std::string> line = {axis.label};
    for (const Way& way : kWays) {
      if (!way.is_direct()) continue;
      line.push_back(Ranges(cells, axis.values, way));
    }
    table.cells.push_back(std::move(line));
  }
  return table;
}

// The explicit methods beside their predicted limits.
Table LimitTable(const std::vector<Row>& rows) {
  Table table;
  table.name = "stability_limits";
  table.caption =
      "Explicit methods: the predicted limit of the step (the least over the motion, "
      "its states of contact included), by what factor the predicted unstable modes "
      "grow over the rollout, and what happened. They agree if a rollout within the "
      "limit is stable, and one beyond it fails or is off by more than the motion. "
      "Modes that grow by less than 1e6 over the rollout may be too slow to see.";
  table.columns = {"axis",      "value",  "method",   "w_max (rad/s)", "limit (s)",
                   "predicted", "growth", "observed", "agreement"};
  for (const Row& row : rows) {
    if (row.Text("prediction", "").empty()) continue;
    table.cells.push_back({row.Text("axis", ""), ValueText(row.Number("value", 0.0)),
                           MethodName(row.Integer("integrator", 0)),
                           FormatValue(row, "omega_max"), FormatValue(row, "limit"),
                           row.Text("prediction", ""), FormatValue(row, "growth", 2),
                           CellText(&row), row.Text("agreement", "")});
  }
  return table;
}

// Cells of which not everything is as one would wish, with the reason in full.
Table ReasonTable(const std::vector<Row>& rows) {
  Table table;
  table.name = "stability_reasons";
  table.caption = "Why cells failed, or their gradient could not be decided.";
  table.columns = {"axis", "value", "method", "solver", "result", "reason"};
  const auto add = [&](const Row& row, const std::string& what,
                       const std::string& why) {
    table.cells.push_back({row.Text("axis", ""), ValueText(row.Number("value", 0.0)),
                           std::to_string(row.Integer("integrator", -1)),
                           row.Text("solver", ""), what, why});
  };
  for (const Row& row : rows) {
    if (row.Text("kind", "") != "stability") continue;
    const std::string why = row.Text("why", row.Text("reason", ""));
    if (!why.empty()) add(row, ResultOf(row), why);
    const std::string gradient_why = row.Text("gradient_why", "");
    if (!gradient_why.empty()) {
      add(row, "gradient " + row.Text("gradient", ""), gradient_why);
    }
  }
  return table;
}

Table EnergyTable(const std::vector<Row>& rows) {
  Table table;
  table.name = "stability_energy";
  table.caption =
      "An undamped free cloth after 4 s in steps of 4 ms: the energy that is left, and "
      "the largest drift of momentum and angular momentum, which all should conserve.";
  table.columns = {"method", "energy at the end / start", "momentum drift",
                   "angular momentum drift", "status"};
  for (const Row& row : rows) {
    if (row.Text("kind", "") != "energy") continue;
    table.cells.push_back(
        {MethodName(row.Integer("integrator", 0)), FormatValue(row, "energy_end", 4),
         FormatValue(row, "momentum_drift", 2), FormatValue(row, "angular_drift", 2),
         row.Text("result", "") + " " + row.Text("why", "")});
  }
  return table;
}

// How often the Krylov solver came to what the direct one came to.
std::string SolverText(const std::vector<Row>& rows) {
  int same = 0, both = 0;
  std::string others;
  for (const StabilityAxis& axis : StabilityAxes()) {
    const Cells cells(rows, axis.name);
    for (double value : axis.values) {
      for (const Way& way : kWays) {
        if (way.is_direct()) continue;
        const Row* krylov = cells.Find(value, way);
        const Row* direct = cells.Find(value, {way.method, "cholesky"});
        if (krylov == nullptr || direct == nullptr) continue;
        ++both;
        if (ResultOf(*krylov) == ResultOf(*direct)) {
          ++same;
        } else {
          others += (others.empty() ? ", but not: " : ", ") + MethodName(way.method) +
                    " at " + axis.label + " " + ValueText(value);
        }
      }
    }
  }
  return "The Krylov solver (cg, tolerance 1e-10) came to the same result as the "
         "direct one (cholesky) in " +
         std::to_string(same) + " of " + std::to_string(both) + " cells" + others + ".";
}

}  // namespace

std::string CountText(const std::vector<Row>& cells) {
  std::map<std::string, int> results, gradients, agreements;
  int count = 0;
  for (const Row& row : cells) {
    if (row.Text("kind", "") != "stability") continue;
    ++count;
    ++results[ResultOf(row)];
    if (!row.Text("gradient", "").empty()) ++gradients[row.Text("gradient", "")];
    if (!row.Text("agreement", "").empty()) ++agreements[row.Text("agreement", "")];
  }
  const auto list = [](const std::map<std::string, int>& counts) {
    std::string text;
    for (const auto& [name, number] : counts) {
      text += (text.empty() ? "" : ", ") + std::to_string(number) + " " + name;
    }
    return text;
  };
  return std::to_string(count) + " cells: " + list(results) + ". Gradients of those " +
         "that are stable: " + list(gradients) + ". Predicted limits of the explicit " +
         "methods: " + list(agreements) + ".";
}

Results StabilityResults(const std::vector<Row>& rows) {
  Results results;
  results.tables = {MethodTable(rows), AdviceTable(rows), RangeTable(rows),
                    TrustTable(rows),  ValueTable(rows),  LimitTable(rows),
                    ReasonTable(rows), EnergyTable(rows)};
  results.tables[0].caption =
      CountText(rows) + "\n\n" + SolverText(rows) + "\n\n" + results.tables[0].caption;
  results.plots = StabilityPlots(rows);
  return results;
}

}  // namespace dpe::experiments
