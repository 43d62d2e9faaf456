#include "experiments/stability/stability_cells.h"

#include "dpe/engine/scene.h"
#include "experiments/output/tables.h"

namespace dpe::experiments {
namespace {

constexpr int kFirstImplicit = 2;

}  // namespace

std::string MethodName(int method) {
  return IntegrationMethodName(static_cast<IntegrationMethod>(method));
}

std::string ValueText(double value) { return FormatNumber(value, 6); }

std::string WayName(const Way& way) {
  const bool has_choice = way.method >= kFirstImplicit;
  return MethodName(way.method) + (has_choice ? std::string(", ") + way.solver : "");
}

std::string ResultOf(const Row& row) {
  const std::string outcome = row.Text("outcome", "done");
  return outcome == "done" ? row.Text("result", "missing") : outcome;
}

bool IsStableResult(const std::string& result) {
  return result == "accurate" || result == "inaccurate" || result == "undecided";
}

Cells::Cells(const std::vector<Row>& rows, const std::string& axis) {
  for (const Row& row : rows) {
    if (row.Text("kind", "") != "stability" || row.Text("axis", "") != axis) continue;
    rows_[{row.Number("value", 0.0), row.Integer("integrator", -1),
           row.Text("solver", "")}] = &row;
  }
}

const Row* Cells::Find(double value, const Way& way) const {
  const auto it = rows_.find({value, way.method, way.solver});
  return it == rows_.end() ? nullptr : it->second;
}

}  // namespace dpe::experiments
