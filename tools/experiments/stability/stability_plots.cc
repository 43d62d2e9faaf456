#include "experiments/stability/stability_plots.h"

#include <cmath>
#include <string>
#include <utility>

#include "dpe/engine/scene.h"
#include "experiments/stability/energy_history.h"
#include "experiments/stability/stability_cells.h"
#include "experiments/stability/stability_scene.h"

namespace dpe::experiments {
namespace {

// The Krylov solver's marks stand this much above the direct one's.
constexpr double kAbove = 0.25;

// The same in every plot: green where all is well, then orange, red where it failed.
constexpr std::pair<const char*, int> kResultStyles[] = {
    {"accurate", 2}, {"inaccurate", 4}, {"undecided", 5}, {"blown_up", 3},
    {"failed", 1},   {"refused", 6},    {"crashed", 0},   {"timed_out", 7}};

Series Marks(const std::string& label) {
  Series series;
  series.label = label;
  series.line = false;
  return series;
}

// One mark per cell: method against value, a series for each result.
Plot AxisPlot(const std::vector<Row>& rows, const StabilityAxis& axis) {
  Plot plot;
  plot.name = "stability_" + axis.name;
  plot.title = "What came of each integrator: " + axis.label;
  plot.x_label = axis.label;
  plot.y_label = "integrator (a little higher: with solver cg)";
  plot.log_x = true;
  for (int method = 0; method <= 4; ++method) {
    plot.y_names.emplace_back(method, MethodName(method));
  }
  for (const auto& [result, style] : kResultStyles) {
    Series series = Marks(result);
    series.style = style;
    for (const Row& row : rows) {
      if (row.Text("kind", "") != "stability" || row.Text("axis", "") != axis.name ||
          ResultOf(row) != result) {
        continue;
      }
      const double value = row.Number("value", 0.0);
      if (value <= 0.0) continue;  // has no place on a logarithmic axis
      series.x.push_back(value);
      series.y.push_back(row.Integer("integrator", 0) +
                         (row.Text("solver", "") == "cg" ? kAbove : 0.0));
    }
    if (!series.x.empty()) plot.series.push_back(series);
  }
  return plot;
}

// @param column    of the rows of kind "energy"
// @param conserved what the samples would be if nothing were lost: plotted is by how
//                  much they are off, where that is not zero
Plot HistoryPlot(const std::vector<Row>& rows, const std::string& column,
                 double conserved, const std::string& title, const std::string& label) {
  Plot plot;
  plot.name = "stability_" + column;
  plot.title = title;
  plot.x_label = "time (s)";
  plot.y_label = label;
  plot.log_y = true;
  for (const Row& row : rows) {
    if (row.Text("kind", "") != "energy") continue;
    Series series;
    series.label = IntegrationMethodName(
        static_cast<IntegrationMethod>(row.Integer("integrator", 0)));
    // Lines that lie on each other are told apart by every second one's marks.
    series.marks = row.Integer("integrator", 0) % 2 == 0;
    series.x = ParseSamples(row.Text("time", ""));
    series.y = ParseSamples(row.Text(column, ""));
    for (double& y : series.y) y = std::abs(y - conserved);
    plot.series.push_back(series);
  }
  return plot;
}

}  // namespace

std::vector<Plot> StabilityPlots(const std::vector<Row>& rows) {
  std::vector<Plot> plots;
  for (const char* axis_name : {"stiffness", "mass", "mass_ratio", "delta", "damping",
                                "wind", "drag", "plane", "sphere"}) {
    for (const StabilityAxis& axis : StabilityAxes()) {
      if (axis.name == axis_name) plots.push_back(AxisPlot(rows, axis));
    }
  }
  plots.push_back(HistoryPlot(
      rows, "energy", 1.0, "Energy drift of an undamped free cloth", "|E / E(0) - 1|"));
  plots.push_back(HistoryPlot(rows, "momentum", 0.0,
                              "Momentum of an undamped free cloth",
                              "|P - P(0)| / sum m |v(0)|"));
  plots.push_back(HistoryPlot(rows, "angular_momentum", 0.0,
                              "Angular momentum of an undamped free cloth",
                              "|L - L(0)| / |L(0)|"));
  return plots;
}

}  // namespace dpe::experiments
