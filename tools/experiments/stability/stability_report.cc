#include "experiments/stability/stability_report.h"

#include <cmath>
#include <cstdio>
#include <map>
#include <tuple>
#include <utility>

#include "dpe/engine/scene.h"
#include "experiments/stability/stability_plots.h"
#include "experiments/stability/stability_scene.h"

namespace dpe::experiments {
namespace {

// Columns of the tables: methods, and solvers where there is a choice.
struct Way {
  int method;
  const char* solver;
};
constexpr Way kWays[] = {{0, "cholesky"}, {1, "cholesky"}, {2, "cholesky"}, {2, "cg"},
                         {3, "cholesky"}, {3, "cg"},       {4, "cholesky"}, {4, "cg"}};
constexpr int kFirstImplicit = 2;
// What to use, the cheapest step first. Explicit Euler costs what symplectic Euler does
// and is never stable for longer steps.
constexpr int kByCost[] = {1, 2, 3, 4};

template <class... Numbers>
std::string Text(const char* format, Numbers... numbers) {
  char buffer[160];
  std::snprintf(buffer, sizeof(buffer), format, numbers...);
  return buffer;
}

std::string MethodName(int method) {
  return IntegrationMethodName(static_cast<IntegrationMethod>(method));
}

std::string WayName(const Way& way) {
  const bool has_choice = way.method >= kFirstImplicit;
  return MethodName(way.method) + (has_choice ? std::string(", ") + way.solver : "");
}

// Rows of one axis by value, method and solver.
class Cells {
 public:
  Cells(const std::vector<Row>& rows, const std::string& axis) {
    for (const Row& row : rows) {
      if (row.Text("kind", "") != "stability" || row.Text("axis", "") != axis) continue;
      rows_[{row.Number("value", 0.0), row.Integer("integrator", -1),
             row.Text("solver", "")}] = &row;
    }
  }
  const Row* Find(double value, const Way& way) const {
    const auto it = rows_.find({value, way.method, way.solver});
    return it == rows_.end() ? nullptr : it->second;
  }

 private:
  std::map<std::tuple<double, int, std::string>, const Row*> rows_;
};

std::string CellText(const Row* row) {
  if (row == nullptr) return "-";
  const std::string result = ResultOf(*row);
  const double error = 100.0 * row->Number("error", 0.0);
  std::string text = result;
  if (result == "accurate" || result == "inaccurate") {
    text += Text(" %.2g %%", error);
  } else if (result == "failed" && row->Has("failed_frame")) {
    text += Text(" at frame %d", row->Integer("failed_frame", -1));
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
      std::vector<std::string> line = {axis.label, Text("%g", value)};
      for (const Way& way : kWays) line.push_back(CellText(cells.Find(value, way)));
      table.cells.push_back(std::move(line));
    }
  }
  return table;
}

std::string RangeText(double first, double last, const std::string& result) {
  if (first == last) return Text("%g: ", first) + result;
  return Text("%g ... %g: ", first, last) + result;
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
    if (std::string(way.solver) == "cholesky") {
      table.columns.push_back(MethodName(way.method));
    }
  }
  for (const StabilityAxis& axis : StabilityAxes()) {
    const Cells cells(rows, axis.name);
    std::vector<std::string> line = {axis.label};
    for (const Way& way : kWays) {
      if (std::string(way.solver) != "cholesky") continue;
      line.push_back(Ranges(cells, axis.values, way));
    }
    table.cells.push_back(std::move(line));
  }
  return table;
}

bool IsTrusted(const Row* row) {
  return row != nullptr && ResultOf(*row) == "accurate" &&
         row->Text("gradient", "") != "wrong";
}

// What to use at one value of an axis.
std::string Advice(const Cells& cells, double value) {
  for (int method : kByCost) {
    if (IsTrusted(cells.Find(value, {method, "cholesky"}))) return MethodName(method);
  }
  int best = -1;
  double least = 0.0;
  for (int method : kByCost) {
    const Row* row = cells.Find(value, {method, "cholesky"});
    if (row == nullptr || ResultOf(*row) != "inaccurate") continue;
    const double error = row->Number("error", 0.0);
    if (best >= 0 && error >= least) continue;
    best = method;
    least = error;
  }
  if (best < 0) return "none";
  return "shorter steps; least off: " + MethodName(best) +
         Text(" (%.2g %%)", 100.0 * least);
}

Table TrustTable(const std::vector<Row>& rows) {
  Table table;
  table.name = "stability_trust";
  table.caption =
      "Which integrator to trust where: those within 5 % whose gradient is not wrong, "
      "and the cheapest of them (explicit_euler left out: symplectic_euler costs the "
      "same).";
  table.columns = {"axis", "value", "use", "accurate", "stable, inaccurate", "fail"};
  for (const StabilityAxis& axis : StabilityAxes()) {
    const Cells cells(rows, axis.name);
    for (double value : axis.values) {
      std::string accurate, inaccurate, failed;
      for (const Way& way : kWays) {
        const Row* row = cells.Find(value, way);
        if (row == nullptr || std::string(way.solver) != "cholesky") continue;
        const std::string result = ResultOf(*row);
        std::string& list =
            IsTrusted(row) ? accurate
            : result == "accurate" || result == "inaccurate" || result == "undecided"
                ? inaccurate
                : failed;
        list += (list.empty() ? "" : ", ") + std::to_string(way.method);
      }
      table.cells.push_back({axis.label, Text("%g", value), Advice(cells, value),
                             accurate, inaccurate, failed});
    }
  }
  return table;
}

// The explicit methods beside their predicted limits.
Table LimitTable(const std::vector<Row>& rows) {
  Table table;
  table.name = "stability_limits";
  table.caption =
      "Explicit methods: the predicted limit of the step (the least over the motion), "
      "by what factor the predicted unstable modes grow over the rollout, and what "
      "happened. A growth below 1e6 may go unseen.";
  table.columns = {"axis",      "value",  "method",   "w_max (rad/s)", "limit (s)",
                   "predicted", "growth", "observed", "agreement"};
  for (const Row& row : rows) {
    if (row.Text("prediction", "").empty()) continue;
    table.cells.push_back({row.Text("axis", ""), Text("%g", row.Number("value", 0.0)),
                           MethodName(row.Integer("integrator", 0)),
                           Text("%.3g", row.Number("omega_max", 0.0)),
                           Text("%.3g", row.Number("limit", 0.0)),
                           row.Text("prediction", ""),
                           Text("%.2g", row.Number("growth", 0.0)), CellText(&row),
                           row.Text("agreement", "")});
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
    table.cells.push_back({row.Text("axis", ""), Text("%g", row.Number("value", 0.0)),
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
    table.cells.push_back({MethodName(row.Integer("integrator", 0)),
                           Text("%.4g", row.Number("energy_end", 0.0)),
                           Text("%.1e", row.Number("momentum_drift", 0.0)),
                           Text("%.1e", row.Number("angular_drift", 0.0)),
                           row.Text("result", "") + " " + row.Text("why", "")});
  }
  return table;
}

}  // namespace

std::string ResultOf(const Row& row) {
  const std::string outcome = row.Text("outcome", "done");
  return outcome == "done" ? row.Text("result", "missing") : outcome;
}

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
  results.tables = {RangeTable(rows), TrustTable(rows),  ValueTable(rows),
                    LimitTable(rows), ReasonTable(rows), EnergyTable(rows)};
  results.tables[0].caption = CountText(rows) + "\n\n" + results.tables[0].caption;
  results.plots = StabilityPlots(rows);
  return results;
}

}  // namespace dpe::experiments
