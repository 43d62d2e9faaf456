#include "experiments/campaign_run.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <regex>
#include <sstream>
#include <thread>

#include "dpe/engine/scene.h"
#include "experiments/campaign.h"
#include "experiments/executors/executor.h"
#include "experiments/executors/internal.h"
#include "experiments/executors/progress.h"
#include "experiments/folder_lock.h"
#include "experiments/machine.h"
#include "experiments/output/report.h"
#include "experiments/output/tables.h"

namespace dpe::experiments {
namespace {

namespace fs = std::filesystem;

std::string ExperimentNames() {
  std::string names;
  for (const Experiment& e : Experiments())
    names += (names.empty() ? "" : ", ") + e.name;
  return names;
}

Campaign CampaignOf(const std::string& name, const Experiment* experiment) {
  if (experiment != nullptr) {
    Campaign campaign;
    campaign.jobs = experiment->jobs();
    campaign.working_dir = fs::current_path().string();
    RequireValidJobs(campaign.jobs, name);
    return campaign;
  }
  if (!fs::exists(name)) {
    throw SceneError("\"" + name +
                     "\" is neither a file nor an experiment; there are " +
                     ExperimentNames());
  }
  return LoadCampaign(name);
}

std::string OutputDir(const CampaignOptions& options) {
  const std::string stem = fs::path(options.name).stem().string();
  const std::string dir =
      options.output_dir.empty() ? "results/" + stem : options.output_dir;
  std::error_code error;
  fs::create_directories(dir, error);
  if (error) throw SceneError(dir + ": cannot be created: " + error.message());
  return fs::canonical(dir).string();
}

std::vector<Job> Selected(const std::vector<Job>& jobs, const std::string& filter) {
  if (filter.empty()) return jobs;
  std::regex expression;
  try {
    expression = std::regex(filter);
  } catch (const std::regex_error& error) {
    throw SceneError("--filter: \"" + filter +
                     "\" is not a regular expression: " + error.what());
  }
  std::vector<Job> selected;
  for (const Job& job : jobs) {
    if (std::regex_search(JobId(job), expression)) selected.push_back(job);
  }
  if (selected.empty()) {
    throw SceneError("--filter: \"" + filter + "\" is in none of the " +
                     std::to_string(jobs.size()) + " ids");
  }
  return selected;
}

std::vector<Job> WithoutRow(const std::vector<Job>& jobs, const RowStore& store,
                            bool retry_failed) {
  std::vector<Job> pending;
  for (const Job& job : jobs) {
    const std::optional<StoredRow> row = store.Find(job);
    const bool is_good =
        row && (!retry_failed || row->result.Text("outcome", "") == "done");
    if (!is_good) pending.push_back(job);
  }
  return pending;
}

int NumAtOnce(const CampaignOptions& options) {
  if (options.num_at_once > 0) return options.num_at_once;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

bool Execute(const CampaignOptions& options, const Campaign& campaign,
             const std::vector<Job>& pending, const RowStore& store,
             const ExecutorCallbacks& callbacks) {
  const WorkerSettings settings = {ProgramPath(), campaign.working_dir,
                                   options.timeout_s};
  if (options.executor == "slurm") {
    SlurmOptions slurm = options.slurm;
    slurm.max_running = options.num_at_once;
    return RunOnSlurm(pending, settings, slurm, store, callbacks);
  }
  return RunLocally(pending, settings, NumAtOnce(options), store, callbacks);
}

void WriteResultFiles(const CampaignOptions& options, const Campaign& campaign,
                      const Experiment* experiment, const RowStore& store,
                      const CampaignCallbacks& callbacks, CampaignOutcome* outcome) {
  ReportContext context;
  const std::string stem = fs::path(options.name).stem().string();
  context.title = experiment != nullptr ? experiment->title : stem;
  context.command = "run_experiments " + options.name;
  context.commit = ProgramCommit(ProgramPath());
  context.num_at_once = options.executor == "local" ? NumAtOnce(options) : 0;
  context.num_jobs = campaign.jobs.size();
  std::vector<Row> rows;
  for (const Job& job : campaign.jobs) {
    const std::optional<StoredRow> row = store.Find(job);
    if (!row) continue;
    rows.push_back(row->row());
    context.rows.push_back(*row);
    ++outcome->outcomes[row->result.Text("outcome", "")];
  }
  if (rows.empty()) return;
  Results results;
  if (experiment != nullptr) {
    results = experiment->results(rows);
  } else {
    results.tables.push_back(TableOfRows(stem, rows));
  }
  std::vector<std::string> messages;
  outcome->files = WriteReport(context, results, store.dir(), &messages);
  for (const std::string& message : messages) callbacks.message(message);
}

}  // namespace

CampaignOutcome RunCampaign(const CampaignOptions& options,
                            const CampaignCallbacks& callbacks) {
  if (options.executor != "local" && options.executor != "slurm") {
    throw SceneError("--executor: \"" + options.executor +
                     "\" is not accepted; expected local or slurm");
  }
  const Experiment* experiment = FindExperiment(options.name);
  const Campaign campaign = CampaignOf(options.name, experiment);
  const std::vector<Job> selected = Selected(campaign.jobs, options.filter);
  CampaignOutcome outcome;
  outcome.output_dir = OutputDir(options);
  const FolderLock lock(outcome.output_dir);
  const RowStore store(outcome.output_dir);
  WriteJobs(store.dir(), campaign.jobs);
  const std::vector<Job> pending = WithoutRow(selected, store, options.retry_failed);
  for (const Job& job : pending) store.Remove(job);
  outcome.num_jobs = static_cast<int>(selected.size());
  outcome.num_found = static_cast<int>(selected.size() - pending.size());
  Progress progress(outcome.num_jobs, outcome.num_found);
  ExecutorCallbacks executor;
  executor.interrupted = callbacks.interrupted;
  executor.finished = [&](const Job&, const std::string& how) {
    progress.JobEnded(how);
  };
  executor.tick = [&](int running) { callbacks.progress(progress.Line(running)); };
  outcome.interrupted = !Execute(options, campaign, pending, store, executor);
  WriteResultFiles(options, campaign, experiment, store, callbacks, &outcome);
  return outcome;
}

std::string CampaignOutcome::Text() const {
  std::ostringstream text;
  int num_rows = 0;
  for (const auto& [name, count] : outcomes) num_rows += count;
  text << num_rows << " rows in " << output_dir;
  if (num_found > 0) text << " (" << num_found << " were there before)";
  const char* separator = ": ";
  for (const auto& [name, count] : outcomes) {
    text << separator << count << ' ' << name;
    separator = ", ";
  }
  text << "\n";
  for (const std::string& file : files) text << "  " << file << "\n";
  if (interrupted) {
    text << "Interrupted; the rows are kept. Run the same command again to go on.\n";
  }
  return text.str();
}

int CampaignOutcome::exit_code() const {
  if (interrupted) return 2;
  const auto done = outcomes.find("done");
  return done != outcomes.end() && done->second > 0 ? 0 : 3;
}

}  // namespace dpe::experiments
