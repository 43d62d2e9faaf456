// The results of a campaign as files.
#ifndef DPE_TOOLS_EXPERIMENTS_OUTPUT_REPORT_H_
#define DPE_TOOLS_EXPERIMENTS_OUTPUT_REPORT_H_

#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "experiments/row_store.h"

namespace dpe::experiments {

struct ReportContext {
  std::string title;
  std::string command;  // that makes it
  std::string commit;   // of the program; empty: not known
  int num_at_once = 0;  // processes beside each other; 0: not known
  size_t num_jobs = 0;  // of the campaign
  std::vector<StoredRow> rows;
};

// report.md: what it is of, tables and plots, and the rows that are not "done".
std::string ReportMarkdown(const ReportContext& context, const Results& results);

// Writes report.md, a CSV file per table and an SVG file per plot into a folder.
// @param messages  receives what the user is to be told: plots that are not drawn
// @return the paths of the files
std::vector<std::string> WriteReport(const ReportContext& context,
                                     const Results& results, const std::string& dir,
                                     std::vector<std::string>* messages);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_OUTPUT_REPORT_H_
