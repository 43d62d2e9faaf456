#include "experiments/fits/experiment2.h"

#include <string>
#include <vector>

#include "experiments/fits/fit_jobs.h"
#include "experiments/fits/predecessor.h"
#include "experiments/output/tables.h"

namespace dpe::experiments {
namespace {

constexpr const char* kPresets[] = {"side", "flag"};
constexpr const char* kUniform = "uniform:10";

std::vector<Job> Jobs() {
  std::vector<Job> jobs;
  for (const char* init : {"auto", kUniform}) {
    for (const char* preset : kPresets) {
      for (const PredecessorForecast& before : PredecessorForecasts()) {
        Job job = PresetFit(preset, before.frames, "nL", init);
        if (init == kUniform) job.Set("horizon", "grow");
        jobs.push_back(job);
      }
    }
  }
  return jobs;
}

const PredecessorForecast* Before(int frames) {
  for (const PredecessorForecast& before : PredecessorForecasts()) {
    if (before.frames == frames) return &before;
  }
  return nullptr;
}

std::vector<std::string> Cells(const Row& row) {
  const bool is_side = row.Text("preset", "") == "side";
  const PredecessorForecast* before = Before(row.Integer("frames", 0));
  std::vector<std::string> cells = {row.Text("preset", ""),
                                    std::to_string(row.Integer("frames", 0)),
                                    row.Text("init", ""),
                                    FormatValue(row, "rms_m"),
                                    FormatValue(row, "validation_rms_m"),
                                    FormatValue(row, "deviation_percent"),
                                    FormatValue(row, "iterations"),
                                    FormatValue(row, "derivative_passes"),
                                    FormatValue(row, "cpu_s"),
                                    EndOf(row)};
  if (before != nullptr) {
    cells.push_back(FormatNumber(is_side ? before->side_rms : before->flag_rms));
    cells.push_back(
        FormatNumber(is_side ? before->side_validation : before->flag_validation));
  }
  return cells;
}

Table ForecastTable(const std::vector<Row>& rows) {
  Table table;
  table.name = "experiment2";
  table.caption =
      "All 726 stiffnesses fitted to the first frames of a motion, then simulated over "
      "500. A small error in the fitted frames is no sign that parameters were "
      "recovered: the error over 500 frames, and the deviation from the true values, "
      "are. Uniform starts grow the horizon. The columns on the right are the "
      "predecessor's, a thesis framework.";
  table.columns = {"scene",
                   "frames",
                   "start",
                   "RMS (m)",
                   "RMS of 500 frames (m)",
                   "deviation (%)",
                   "iterations",
                   "derivative passes",
                   "cpu_s",
                   "end",
                   "before: RMS (m)",
                   "before: RMS of 500 frames (m)"};
  for (const Row& row : rows) table.cells.push_back(Cells(row));
  return table;
}

Series Measured(const std::vector<Row>& rows, const std::string& preset,
                const std::string& init) {
  Series series;
  series.label =
      "dpe, " + preset + (init == "auto" ? ", default start" : ", all at 10");
  for (const Row& row : rows) {
    if (row.Text("preset", "") != preset || row.Text("init", "") != init) continue;
    series.x.push_back(row.Integer("frames", 0));
    series.y.push_back(NumberOf(&row, "validation_rms_m"));
  }
  return series;
}

Plot ErrorAgainstFrames(const std::vector<Row>& rows) {
  Plot plot;
  plot.name = "experiment2";
  plot.title = "Error over 500 frames after a fit to the first N";
  plot.x_label = "frames fitted, N";
  plot.y_label = "RMS position error over 500 frames (m)";
  plot.log_y = true;
  for (const char* preset : kPresets) {
    for (const char* init : {"auto", kUniform}) {
      plot.series.push_back(Measured(rows, preset, init));
    }
  }
  for (const char* preset : kPresets) {
    Series before;
    before.label = std::string("predecessor, ") + preset;
    const bool is_side = preset == kPresets[0];
    for (const PredecessorForecast& forecast : PredecessorForecasts()) {
      before.x.push_back(forecast.frames);
      before.y.push_back(is_side ? forecast.side_validation : forecast.flag_validation);
    }
    plot.series.push_back(before);
  }
  return plot;
}

Results MakeResults(const std::vector<Row>& rows) {
  return {{ForecastTable(rows)}, {ErrorAgainstFrames(rows)}};
}

}  // namespace

Experiment Experiment2() {
  return {"experiment2",
          "stiffnesses fitted to 20 to 200 frames of side and flag, validated over 500",
          "Experiment 2: forecasts from few frames", Jobs, MakeResults};
}

}  // namespace dpe::experiments
