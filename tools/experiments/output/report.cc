#include "experiments/output/report.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "dpe/engine/scene_io.h"
#include "experiments/campaign.h"
#include "experiments/output/gnuplot.h"
#include "experiments/output/tables.h"

namespace dpe::experiments {
namespace {

// "2026-11-25 to 2026-11-26" and the machines, as the rows have them.
std::string Provenance(const ReportContext& context) {
  std::set<std::string> dates, machines;
  for (const StoredRow& row : context.rows) {
    dates.insert(row.machine.Text("date", ""));
    machines.insert(row.machine.Text("processor", "?") + ", " +
                    std::to_string(row.machine.Integer("cores", 0)) + " cores");
  }
  std::ostringstream text;
  if (!dates.empty()) {
    text << "- date: " << *dates.begin();
    if (dates.size() > 1) text << " to " << *dates.rbegin();
    text << "\n";
  }
  for (const std::string& machine : machines) text << "- machine: " << machine << "\n";
  if (context.num_at_once > 1) {
    text << "- up to " << context.num_at_once
         << " jobs ran beside each other: times in columns ending in _s are those of a "
            "shared machine\n";
  }
  if (!context.commit.empty()) text << "- commit: " << context.commit << "\n";
  return text.str();
}

// Counted by outcome, and the reasons of those that are not "done".
std::string Outcomes(const ReportContext& context) {
  std::map<std::string, int> counts;
  std::string reasons;
  for (const StoredRow& row : context.rows) {
    const std::string outcome = row.result.Text("outcome", "");
    ++counts[outcome];
    if (outcome == "done") continue;
    std::string reason = row.result.Text("reason", "");
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    reasons += "- " + JobId(row.job) + ": " + outcome + ": " + reason + "\n";
  }
  std::ostringstream text;
  text << "- jobs: " << context.num_jobs;
  for (const auto& [outcome, count] : counts) text << ", " << count << ' ' << outcome;
  if (context.rows.size() < context.num_jobs) {
    text << ", " << context.num_jobs - context.rows.size() << " without a row yet";
  }
  text << "\n";
  if (!reasons.empty()) text << "\nNot done:\n\n" << reasons;
  return text.str();
}

}  // namespace

std::string ReportMarkdown(const ReportContext& context, const Results& results) {
  std::ostringstream text;
  text << "# " << context.title << "\n\n- command: `" << context.command << "`\n"
       << Provenance(context) << Outcomes(context);
  for (const Table& table : results.tables) {
    text << "\n## " << table.name << "\n\n"
         << TableToMarkdown(table) << "\n[" << table.name << ".csv](" << table.name
         << ".csv)\n";
  }
  for (const Plot& plot : results.plots) {
    text << "\n![" << plot.title << "](" << plot.name << ".svg)\n";
  }
  return text.str();
}

std::vector<std::string> WriteReport(const ReportContext& context,
                                     const Results& results, const std::string& dir,
                                     std::vector<std::string>* messages) {
  std::vector<std::string> paths = {dir + "/report.md"};
  WriteFileAtomically(paths[0], ReportMarkdown(context, results));
  for (const Table& table : results.tables) {
    paths.push_back(dir + "/" + table.name + ".csv");
    WriteFileAtomically(paths.back(), TableToCsv(table));
  }
  for (const Plot& plot : results.plots) {
    const std::string message = DrawPlot(plot, dir);
    if (message.empty()) {
      paths.push_back(dir + "/" + plot.name + ".svg");
    } else if (std::find(messages->begin(), messages->end(), message) ==
               messages->end()) {
      messages->push_back(message);
    }
  }
  return paths;
}

}  // namespace dpe::experiments
