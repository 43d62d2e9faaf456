#include "experiments/stability/stability_advice.h"

#include <algorithm>
#include <map>
#include <utility>

#include "experiments/output/tables.h"
#include "experiments/stability/stability_cell.h"
#include "experiments/stability/stability_cells.h"
#include "experiments/stability/stability_scene.h"

namespace dpe::experiments {
namespace {

// What to use, the cheapest step first. Explicit Euler costs what symplectic Euler does
// and is never stable for longer steps.
constexpr int kByCost[] = {1, 2, 3, 4};

// Above this fraction of the error that counts as accurate a method is barely so.
constexpr double kBarely = 0.8;

constexpr const char* kSamePlace = "are in the same place";

bool IsTrusted(const Row* row) {
  if (row == nullptr || ResultOf(*row) != "accurate") return false;
  const std::string gradient = row->Text("gradient", "");
  return gradient == "right" || gradient == "not decidable";
}

// A motion into which spring ends meet has no continuation: a method that steps over
// the very place is not better than those that say so.
bool SpringEndsMeet(const Cells& cells, double value) {
  return std::any_of(std::begin(kWays), std::end(kWays), [&](const Way& way) {
    const Row* row = cells.Find(value, way);
    return row != nullptr && row->Text("why", "").find(kSamePlace) != std::string::npos;
  });
}

struct Advice {
  std::string use;
  std::string detail;
};

// What to use at one value of an axis.
Advice AdviceAt(const Cells& cells, double value) {
  if (SpringEndsMeet(cells, value)) {
    return {"none: a spring whose ends meet has no direction", ""};
  }
  for (int method : kByCost) {
    const Row* row = cells.Find(value, {method, "cholesky"});
    if (!IsTrusted(row)) continue;
    const double error = row->Number("error", 0.0);
    return {MethodName(method) + (error > kBarely * kAccurate ? ", barely" : ""),
            ", " + FormatNumber(100.0 * error, 2) + " %"};
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
  if (best < 0) return {"none", ""};
  return {"shorter steps (least off: " + MethodName(best) + ")",
          ", " + FormatNumber(100.0 * least, 2) + " %"};
}

// "1 ... 50: symplectic_euler; 1000: tr_bdf2".
std::string AdviceText(const Cells& cells, const std::vector<double>& values) {
  std::string text;
  for (size_t begin = 0, end = 0; begin < values.size(); begin = end) {
    const std::string use = AdviceAt(cells, values[begin]).use;
    while (end < values.size() && AdviceAt(cells, values[end]).use == use) ++end;
    if (!text.empty()) text += "; ";
    text += ValueText(values[begin]);
    if (end - begin > 1) text += " ... " + ValueText(values[end - 1]);
    text += ": " + use;
  }
  return text;
}

template <class Container>
std::string Joined(const Container& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

// "explicit_euler, symplectic_euler at 1e+06, 1e+09: NAME; ..."
std::string FailureText(const Cells& cells, const std::vector<double>& values) {
  using Values = std::vector<std::string>;
  std::vector<std::pair<std::pair<Values, std::string>, Values>> groups;  // methods
  for (const Way& way : kWays) {
    if (!way.is_direct()) continue;
    std::map<std::string, Values> by_name;
    for (double value : values) {
      const Row* row = cells.Find(value, way);
      if (row == nullptr || IsStableResult(ResultOf(*row))) continue;
      by_name[FailureName(*row)].push_back(ValueText(value));
    }
    for (const auto& [name, at] : by_name) {
      const std::pair<Values, std::string> key(at, name);
      auto it = std::find_if(groups.begin(), groups.end(),
                             [&](const auto& group) { return group.first == key; });
      if (it == groups.end()) it = groups.insert(it, {key, {}});
      it->second.push_back(MethodName(way.method));
    }
  }
  std::string text;
  for (const auto& [key, methods] : groups) {
    text += (text.empty() ? "" : "; ") + Joined(methods) + " at " + Joined(key.first) +
            ": " + key.second;
  }
  return text;
}

}  // namespace

std::string FailureName(const Row& row) {
  const std::string result = ResultOf(row);
  if (result == "blown_up") return "blows up, with finite numbers";
  const std::string why = row.Text("why", "");
  if (result != "failed" || why.empty()) return result;
  // "WHAT in object O on the way to frame F, step S: reason".
  const size_t colon = why.find(": ");
  const std::string what = why.substr(0, std::min(why.find(" in object"), colon));
  if (why.find("is unstable for steps") != std::string::npos) {
    return what + ": steps too long";
  }
  if (why.find(kSamePlace) != std::string::npos) {
    return what + ": the ends of a spring are in the same place";
  }
  if (colon == std::string::npos) return what;
  const std::string reason = why.substr(colon + 2);
  return what + ": " + reason.substr(0, std::min(reason.find(" ("), reason.find(';')));
}

Table MethodTable(const std::vector<Row>& rows) {
  Table table;
  table.name = "stability_methods";
  table.caption =
      "How many of the tested values each method came through. Accurate: within 5 % of "
      "the motion; inaccurate: stable, but further off; undecided: stable, but no "
      "reference is good enough to tell. The rest fails, by a name that the status "
      "says (stability_advice, stability_reasons).";
  table.columns = {"method",    "values", "accurate",      "inaccurate",
                   "undecided", "fails",  "gradient right"};
  for (const Way& way : kWays) {
    std::map<std::string, int> results;
    int values = 0, stable = 0, right = 0;
    for (const Row& row : rows) {
      if (row.Text("kind", "") != "stability" ||
          row.Integer("integrator", -1) != way.method ||
          row.Text("solver", "") != way.solver) {
        continue;
      }
      ++values;
      ++results[ResultOf(row)];
      stable += IsStableResult(ResultOf(row));
      right += row.Text("gradient", "") == "right";
    }
    if (values == 0) continue;
    table.cells.push_back(
        {WayName(way), std::to_string(values), std::to_string(results["accurate"]),
         std::to_string(results["inaccurate"]), std::to_string(results["undecided"]),
         std::to_string(values - stable), std::to_string(right)});
  }
  return table;
}

Table AdviceTable(const std::vector<Row>& rows) {
  Table table;
  table.name = "stability_advice";
  table.caption =
      "Which integrator to trust where. \"Use\" names the one with the cheapest step "
      "among those that are within 5 % of the motion (barely: more than 4 % off) and "
      "whose gradient is not wrong, with the direct solver and steps of 2 ms unless "
      "the axis says otherwise. (Not explicit_euler: symplectic_euler costs the same "
      "and is stable for longer steps.) Ranges are from tested value to tested value; "
      "between "
      "two ranges nothing was tested. A contact that is over within a step throws "
      "vertices back as fast as they came; linearly_implicit_euler and implicit_euler "
      "stop them at the surface, and tr_bdf2 throws them back at another speed, which "
      "may be higher: stable, but inaccurate, until steps are shorter than the "
      "contact.";
  table.columns = {"axis", "use", "fails"};
  for (const StabilityAxis& axis : StabilityAxes()) {
    const Cells cells(rows, axis.name);
    table.cells.push_back(
        {axis.label, AdviceText(cells, axis.values), FailureText(cells, axis.values)});
  }
  return table;
}

Table TrustTable(const std::vector<Row>& rows) {
  Table table;
  table.name = "stability_trust";
  table.caption =
      "The same value by value, with the numbers of the methods: 0 explicit_euler, 1 "
      "symplectic_euler, 2 linearly_implicit_euler, 3 implicit_euler, 4 tr_bdf2.";
  table.columns = {"axis", "value", "use", "accurate", "stable, inaccurate", "fail"};
  for (const StabilityAxis& axis : StabilityAxes()) {
    const Cells cells(rows, axis.name);
    for (double value : axis.values) {
      std::string accurate, inaccurate, failed;
      for (const Way& way : kWays) {
        const Row* row = cells.Find(value, way);
        if (row == nullptr || !way.is_direct()) continue;
        std::string& list = IsTrusted(row)                   ? accurate
                            : IsStableResult(ResultOf(*row)) ? inaccurate
                                                             : failed;
        list += (list.empty() ? "" : ", ") + std::to_string(way.method);
      }
      const Advice advice = AdviceAt(cells, value);
      table.cells.push_back({axis.label, ValueText(value), advice.use + advice.detail,
                             accurate, inaccurate, failed});
    }
  }
  return table;
}

}  // namespace dpe::experiments
