// What an experiment is to the program that runs it: jobs, and what to make of their
// rows.
#ifndef DPE_TOOLS_EXPERIMENTS_EXPERIMENT_H_
#define DPE_TOOLS_EXPERIMENTS_EXPERIMENT_H_

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/record.h"

namespace dpe::experiments {

// A job is a record with at least
//   id     text, unique in its campaign; letters, digits and . _ - = + only
//   kind   text, the name of a JobKind
// and the arguments of its kind. It is run in a process of its own, in any order, on
// any machine that sees the files that it names.
using Job = Record;

// One row of results: what the job reports, after the job's own keys. Columns whose
// name ends in "_s" (seconds) or "_mib" (memory) are measurements of the machine, all
// others must be the same whenever and wherever the job runs. The executor adds
//   outcome    "done", or "failed", "crashed", "timed_out"
//   reason     text, why it is not "done"
//   wall_s, cpu_s, peak_mib   of the process
using Row = Record;

// A kind of job: a function from its arguments to what it measured.
struct JobKind {
  std::string name;
  std::string summary;  // one sentence, for --help
  // @throws std::exception for bad arguments and for what cannot be done; the row then
  //         says "failed" and why
  std::function<Record(const Job& job)> run;
};

// Every kind of job that there is.
const std::vector<JobKind>& JobKinds();

// A table as it is written into TITLE.csv and into the Markdown report.
struct Table {
  std::string name;     // of its file: "experiment1"
  std::string caption;  // Markdown, what it teaches
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> cells;  // rows of formatted text
};

// One curve or set of marks of a plot.
struct Series {
  std::string label;
  bool line = true;   // joined by a line
  bool marks = true;  // marked
  std::vector<double> x, y;
  std::vector<std::string> annotations;  // beside the marks; empty: none
  int style = -1;  // colour and mark, from 0; negative: its place in the plot
};

// A plot, drawn by gnuplot into NAME.svg.
struct Plot {
  std::string name;
  std::string title;
  std::string x_label, y_label;  // with units
  bool log_x = false, log_y = false;
  // Names in place of numbers along the y axis; empty: numbers.
  std::vector<std::pair<double, std::string>> y_names;
  std::vector<Series> series;
};

struct Results {
  std::vector<Table> tables;
  std::vector<Plot> plots;
};

// A campaign that the program knows by name.
struct Experiment {
  std::string name;
  std::string summary;  // one sentence, for --help
  std::string title;    // of the report
  std::function<std::vector<Job>()> jobs;
  // Rows in the order of the jobs, those that failed included.
  std::function<Results(const std::vector<Row>& rows)> results;
};

const std::vector<Experiment>& Experiments();

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_EXPERIMENT_H_
