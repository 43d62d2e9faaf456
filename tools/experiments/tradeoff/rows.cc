#include "experiments/tradeoff/rows.h"

#include <limits>

#include "experiments/tradeoff/candidate.h"

namespace dpe::experiments::tradeoff {
namespace {

constexpr int kNumMethods = 5;

void AddPoint(const CostAndError& point, double scale_x, double scale_y,
              Series* series) {
  series->x.push_back(point.cost * scale_x);
  series->y.push_back(point.error * scale_y);
}

}  // namespace

const std::vector<std::string>& TradeoffScenes() {
  static const std::vector<std::string> scenes = {"side", "corners", "flag"};
  return scenes;
}

std::vector<Row> RowsOf(const std::vector<Row>& rows, const std::string& kind,
                        const std::string& scene) {
  std::vector<Row> found;
  for (const Row& row : rows) {
    if (row.Text("kind", "") == kind && row.Text("scene", "") == scene) {
      found.push_back(row);
    }
  }
  return found;
}

std::string WhyNot(const Row& row) {
  const std::string outcome = row.Text("outcome", "done");
  if (outcome != "done") return outcome + ": " + row.Text("reason", "");
  return row.Text("stopped", "");
}

double Measured(const Row& row, const std::string& key) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  return WhyNot(row).empty() ? row.Number(key, nan) : nan;
}

std::vector<CostAndError> Points(const std::vector<Row>& rows, const std::string& cost,
                                 const std::string& error) {
  std::vector<CostAndError> points;
  for (const Row& row : rows) {
    points.push_back({Measured(row, cost), Measured(row, error)});
  }
  return points;
}

std::string SettingsOf(const Row& row) {
  return SettingsText(CandidateFromRecord(row).settings);
}

std::vector<Series> TradeoffSeries(const std::vector<Row>& rows,
                                   const std::vector<CostAndError>& points,
                                   double scale_x, double scale_y,
                                   const std::function<std::string(const Row&)>& name) {
  std::vector<Series> all(kNumMethods);
  Series named;
  named.label = "presets";
  named.line = false;
  for (int m = 0; m < kNumMethods; ++m) {
    all[m].label = IntegrationMethodName(static_cast<IntegrationMethod>(m));
    all[m].line = false;
  }
  for (size_t i = 0; i < rows.size(); ++i) {
    const auto method = CandidateFromRecord(rows[i]).settings.method;
    AddPoint(points[i], scale_x, scale_y, &all[static_cast<int>(method)]);
    const std::string text = name(rows[i]);
    if (text.empty()) continue;
    AddPoint(points[i], scale_x, scale_y, &named);
    named.annotations.push_back(text);
  }
  Series front;
  front.label = "front";
  front.marks = false;
  for (size_t i : ParetoFront(points)) AddPoint(points[i], scale_x, scale_y, &front);
  all.push_back(front);
  all.push_back(named);
  return all;
}

}  // namespace dpe::experiments::tradeoff
