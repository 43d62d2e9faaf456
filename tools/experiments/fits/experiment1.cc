#include "experiments/fits/experiment1.h"

#include <cmath>
#include <string>
#include <vector>

#include "experiments/fits/fit_jobs.h"
#include "experiments/fits/predecessor.h"
#include "experiments/output/tables.h"

namespace dpe::experiments {
namespace {

struct Case {
  const char* preset;
  int frames;
};
constexpr Case kCases[] = {
    {"side", 100}, {"corners", 100}, {"flag", 20}, {"flag", 100}};
constexpr const char* kSettings[] = {"Gn", "Ln", "nG", "nL", "GG", "LL"};
// The last is where the predecessor starts.
constexpr const char* kStarts[] = {"auto", "uniform:10", "uniform:0.0001"};

// Only a parameterization without L has a floor that is not 0.
bool HasFloor(const std::string& settings) {
  return settings.find('L') == std::string::npos;
}

std::string FloorId(const std::string& preset, int frames,
                    const std::string& settings) {
  return "floor_" + preset + "-" + std::to_string(frames) + "_" + settings;
}

Job FloorJob(const std::string& preset, int frames, const std::string& settings) {
  Job job;
  job.Set("id", Record::Value(FloorId(preset, frames, settings)));
  job.Set("kind", "floor");
  job.Set("preset", Record::Value(preset));
  job.Set("frames", frames);
  job.Set("settings", Record::Value(settings));
  return job;
}

std::vector<Job> Jobs() {
  std::vector<Job> jobs;
  for (const char* start : kStarts) {
    for (const Case& c : kCases) {
      for (const char* settings : kSettings) {
        jobs.push_back(PresetFit(c.preset, c.frames, settings, start));
      }
    }
  }
  for (const Case& c : kCases) {
    for (const char* settings : kSettings) {
      if (HasFloor(settings)) jobs.push_back(FloorJob(c.preset, c.frames, settings));
    }
  }
  return jobs;
}

double FloorOf(const Row& row, const std::vector<Row>& rows) {
  const std::string settings = row.Text("settings", "");
  if (!HasFloor(settings)) return 0.0;
  const std::string id =
      FloorId(row.Text("preset", ""), row.Integer("frames", 0), settings);
  return NumberOf(FindRow(rows, id), "floor_m");
}

// RMS / floor with enough digits to see a thousandth.
std::string Ratio(double rms, double floor) {
  return floor > 0.0 ? FormatNumber(rms / floor, 6) : "";
}

std::vector<std::string> Cells(const Row& row, const std::vector<Row>& rows) {
  const std::string preset = row.Text("preset", "");
  const std::string settings = row.Text("settings", "");
  const int frames = row.Integer("frames", 0);
  const double floor = FloorOf(row, rows);
  std::vector<std::string> cells = {preset,
                                    std::to_string(frames),
                                    settings,
                                    row.Text("init", ""),
                                    FormatValue(row, "rms_m"),
                                    FormatNumber(floor),
                                    Ratio(NumberOf(&row, "rms_m"), floor),
                                    FormatValue(row, "deviation_percent"),
                                    FormatValue(row, "validation_rms_m"),
                                    FormatValue(row, "iterations"),
                                    FormatValue(row, "evaluations"),
                                    FormatValue(row, "derivative_passes"),
                                    FormatValue(row, "cpu_s"),
                                    EndOf(row)};
  const PredecessorFit* before = FindPredecessorFit(preset, frames, settings);
  for (const double value : {before != nullptr ? before->rms : std::nan(""),
                             before != nullptr ? before->floor : std::nan(""),
                             before != nullptr ? before->deviation : std::nan(""),
                             before != nullptr ? before->cpu : std::nan("")}) {
    cells.push_back(FormatNumber(value, 4));
  }
  return cells;
}

Table FitTable(const std::vector<Row>& rows) {
  Table table;
  table.name = "experiment1";
  table.caption =
      "Fits to the motion that a scene's own parameters make (12 x 12 vertices, 726 "
      "springs). Settings are two letters, mass then stiffness: n fixed at the truth, "
      "G "
      "one value, L one per vertex or spring. The floor is the least RMS that the "
      "parameterization can reach, found by scanning it without the estimator; that of "
      "L is 0. The deviation is the mean relative one from the true values. RMS is per "
      "vertex and frame. cpu_s is that of the job's whole process, validation over 500 "
      "frames included. The columns on the right are the predecessor's, a thesis "
      "framework measured on one core; it starts every parameter at 0.0001, and its "
      "integrator differs, so that its floors do.";
  table.columns = {"scene",
                   "frames",
                   "settings",
                   "start",
                   "RMS (m)",
                   "floor (m)",
                   "RMS / floor",
                   "deviation (%)",
                   "RMS of 500 frames (m)",
                   "iterations",
                   "rollouts",
                   "derivative passes",
                   "cpu_s",
                   "end",
                   "before: RMS (m)",
                   "before: floor (m)",
                   "before: deviation (%)",
                   "before: cpu_s"};
  for (const Row& row : rows) {
    if (row.Text("kind", "") == "estimate") table.cells.push_back(Cells(row, rows));
  }
  return table;
}

// Those of one start whose parameterization can, or cannot, represent the truth.
Series FitSeries(const std::vector<Row>& rows, bool is_default, bool has_floor,
                 const std::string& label) {
  Series series;
  series.label = label;
  series.line = false;
  for (const Row& row : rows) {
    if (row.Text("kind", "") != "estimate" ||
        HasFloor(row.Text("settings", "")) != has_floor ||
        (row.Text("init", "") == "auto") != is_default) {
      continue;
    }
    series.x.push_back(NumberOf(&row, "cpu_s"));
    series.y.push_back(NumberOf(&row, "rms_m"));
  }
  return series;
}

Series BeforeSeries(bool has_floor, const std::string& label) {
  Series series;
  series.label = label;
  series.line = false;
  for (const PredecessorFit& fit : PredecessorFits()) {
    if (HasFloor(fit.settings) != has_floor) continue;
    series.x.push_back(fit.cpu);
    series.y.push_back(fit.rms);
  }
  return series;
}

Plot ErrorAgainstTime(const std::vector<Row>& rows) {
  Plot plot;
  plot.name = "experiment1";
  plot.title = "What fits reach, and in what time";
  plot.x_label = "processor time of a fit (s)";
  plot.y_label = "RMS position error (m)";
  plot.log_x = plot.log_y = true;
  plot.series = {FitSeries(rows, true, false, "dpe, many values"),
                 FitSeries(rows, true, true, "dpe, one value"),
                 FitSeries(rows, false, false, "dpe, uniform start, many"),
                 FitSeries(rows, false, true, "dpe, uniform start, one"),
                 BeforeSeries(false, "predecessor, many values"),
                 BeforeSeries(true, "predecessor, one value")};
  return plot;
}

Results MakeResults(const std::vector<Row>& rows) {
  return {{FitTable(rows)}, {ErrorAgainstTime(rows)}};
}

}  // namespace

Experiment Experiment1() {
  return {"experiment1",
          "side, corners and flag with masses or stiffnesses as one value or as many, "
          "from three starts, beside the floors",
          "Experiment 1: what each parameterization reaches", Jobs, MakeResults};
}

}  // namespace dpe::experiments
